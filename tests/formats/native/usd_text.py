"""USD layers as text: what tests and the fuzzer begin with."""

from collections.abc import Mapping

HEAD = """#usda 1.0
(
    defaultPrim = "figure"
    metersPerUnit = {metres}
    upAxis = "{up}"
    timeCodesPerSecond = {rate}
    {span}
)
"""
SPAN = "startTimeCode = {0}\n    endTimeCode = {1}"
POINTS = "(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)"
FACES = """
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
"""


def layer(
    body: str, *, metres: float = 1, up: str = "Y", rate: float = 30, span: tuple[float, float] | None = None
) -> bytes:
    """A layer with a body."""
    stated = SPAN.format(*span) if span else ""
    return (HEAD.format(metres=metres, up=up, rate=rate, span=stated) + body).encode()


def samples(values: Mapping[float, str]) -> str:
    """Time samples."""
    return "{ " + ", ".join(f"{code}: {value}" for code, value in values.items()) + " }"


def square(more: str = "", name: str = "square") -> str:
    """A mesh of one square; `more` is put into it."""
    points = "" if "points" in more else f"point3f[] points = [{POINTS}]"
    return f'    def Mesh "{name}"\n    {{{FACES}        {points}\n        {more}\n    }}\n'


def sliding_square(frames: int = 5, first: float = 0, **settings: float | str) -> bytes:
    """A square that goes one unit along x with every frame, by its transform."""
    slide = samples({first + frame: f"({frame}, 0, 0)" for frame in range(frames)})
    more = f"double3 xformOp:translate.timeSamples = {slide}\n"
    more += '        uniform token[] xformOpOrder = ["xformOp:translate"]'
    return layer(f'def Xform "figure"\n{{\n{square(more)}}}\n', span=(first, first + frames - 1), **settings)  # type: ignore[arg-type]


def sliding_points(frames: int = 5) -> bytes:
    """The same by its points."""
    rows = {
        frame: f"[({frame}, 0, 0), ({frame + 1}, 0, 0), ({frame + 1}, 1, 0), ({frame}, 1, 0)]"
        for frame in range(frames)
    }
    return layer(f'def Xform "figure"\n{{\n{square(f"point3f[] points.timeSamples = {samples(rows)}")}}}\n')


IDENTITY = "( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1) )"
RAISED = "( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 1, 0, 1) )"


def bending_strip(method: str = "classicLinear", place: str = "(0, 0, 0)") -> bytes:
    """Two squares one above the other; the upper one turns with the joint `hip/knee` by 90 degrees in 30 frames."""
    turn = samples({0: "[(1, 0, 0, 0), (1, 0, 0, 0)]", 30: "[(1, 0, 0, 0), (0.70710678, 0, 0, 0.70710678)]"})
    return layer(
        f"""def SkelRoot "figure"
{{
    def Skeleton "skeleton" (prepend apiSchemas = ["SkelBindingAPI"])
    {{
        uniform token[] joints = ["hip", "hip/knee"]
        uniform matrix4d[] bindTransforms = [{IDENTITY}, {RAISED}]
        uniform matrix4d[] restTransforms = [{IDENTITY}, {RAISED}]
        rel skel:animationSource = </figure/skeleton/bend>
        double3 xformOp:translate = {place}
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def SkelAnimation "bend"
        {{
            uniform token[] joints = ["hip", "hip/knee"]
            float3[] translations = [(0, 0, 0), (0, 1, 0)]
            quatf[] rotations.timeSamples = {turn}
            half3[] scales = [(1, 1, 1), (1, 1, 1)]
        }}
    }}
    def Mesh "strip" (prepend apiSchemas = ["SkelBindingAPI"])
    {{
        int[] faceVertexCounts = [4, 4]
        int[] faceVertexIndices = [0, 1, 3, 2, 2, 3, 5, 4]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), (0, 2, 0), (1, 2, 0)]
        rel skel:skeleton = </figure/skeleton>
        uniform token primvars:skel:skinningMethod = "{method}"
        int[] primvars:skel:jointIndices = [0, 0, 0, 0, 0, 1, 0, 1, 1, 0, 1, 0] (
            elementSize = 2
            interpolation = "vertex"
        )
        float[] primvars:skel:jointWeights = [1, 0, 1, 0, 0.5, 0.5, 0.5, 0.5, 1, 0, 1, 0] (
            elementSize = 2
            interpolation = "vertex"
        )
    }}
}}
""",
        span=(0, 30),
    )


def blending_square() -> bytes:
    """A corner that rises to a shape in between at half its weight and sinks from it to the shape itself."""
    return layer(
        f"""def SkelRoot "figure"
{{
    def Skeleton "skeleton" (prepend apiSchemas = ["SkelBindingAPI"])
    {{
        uniform token[] joints = ["hip"]
        uniform matrix4d[] bindTransforms = [{IDENTITY}]
        uniform matrix4d[] restTransforms = [{IDENTITY}]
        rel skel:animationSource = </figure/skeleton/rise>
        def SkelAnimation "rise"
        {{
            uniform token[] blendShapes = ["other", "corner"]
            float[] blendShapeWeights.timeSamples = {samples({0: "[1, 0]", 30: "[1, 1]"})}
        }}
    }}
    def Mesh "square" (prepend apiSchemas = ["SkelBindingAPI"])
    {{{FACES}
        point3f[] points = [{POINTS}]
        rel skel:skeleton = </figure/skeleton>
        uniform token[] skel:blendShapes = ["corner"]
        rel skel:blendShapeTargets = </figure/square/corner>
        def BlendShape "corner"
        {{
            uniform vector3f[] offsets = [(0, 0, 1)]
            uniform vector3f[] inbetweens:half = [(0, 0, 4)] (weight = 0.5)
            uniform int[] pointIndices = [2]
        }}
    }}
}}
""",
        span=(0, 30),
    )


def nested_references(levels: int) -> bytes:
    """Each prim twice what the one before it is."""
    body = 'def "L0"\n{\ndef "x"\n{\n}\n}\n'
    for level in range(1, levels + 1):
        twice = "".join(f'def "{name}" (\nprepend references = </L{level - 1}>\n)\n{{\n}}\n' for name in "ab")
        body += f'def "L{level}"\n{{\n{twice}}}\n'
    return layer(body)
