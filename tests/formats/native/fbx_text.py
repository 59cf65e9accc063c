"""FBX files as text, made of a few objects: what tests and the fuzzer begin with."""

from collections.abc import Sequence
from dataclasses import dataclass, field

TICKS = 46_186_158_000
"""Of the format's clock in a second."""

TIME_MODES = {120: 1, 60: 3, 30: 6, 25: 10, 24: 11}
AXES = {"x": 0, "y": 1, "z": 2}


def _row(name: str, kind: str, *values: object) -> str:
    return f'P: "{name}", "{kind}", "", "A",' + ",".join(map(str, values))


def _array(name: str, values: Sequence[object]) -> str:
    return f"{name}: *{len(values)} {{\na: {','.join(map(str, values))}\n}}"


@dataclass
class FbxText:
    """Collects objects and connections; every method answers the number that later ones refer to."""

    rate: int = 30
    unit_centimetres: float = 1.0
    up: str = "y"
    objects: list[str] = field(default_factory=list)
    connections: list[str] = field(default_factory=list)
    takes: list[str] = field(default_factory=list)

    def add(self, kind: str, name: str, subtype: str, *lines: str) -> int:
        """One object."""
        number = 100 + len(self.objects)
        self.objects.append(f'{kind}: {number}, "{kind}::{name}", "{subtype}" {{\n' + "\n".join(lines) + "\n}")
        return number

    def connect(self, source: int, target: int, prop: str = "") -> None:
        """`source` belongs to `target`, or to one of its properties."""
        self.connections.append(f'C: "OP",{source},{target}, "{prop}"' if prop else f'C: "OO",{source},{target}')

    def model(self, name: str, *rows: tuple[object, ...], parent: int = 0, subtype: str = "Null") -> int:
        """A node; each row is a property, such as `("Lcl Translation", "Lcl Translation", 1, 2, 3)`."""
        found = "\n".join(_row(str(row[0]), str(row[1]), *row[2:]) for row in rows)
        number = self.add("Model", name, subtype, "Version: 232", f"Properties70: {{\n{found}\n}}")
        self.connect(number, parent)
        return number

    def mesh(self, points: Sequence[Sequence[float]], polygons: Sequence[Sequence[int]], node: int) -> int:
        """The mesh of a node."""
        corners = [corner if corner != face[-1] else -corner - 1 for face in polygons for corner in face]
        geometry = self.add(
            "Geometry", "", "Mesh",
            _array("Vertices", [x for point in points for x in point]), _array("PolygonVertexIndex", corners),
        )  # fmt: skip
        self.connect(geometry, node)
        return geometry

    def material(self, name: str, colour: Sequence[float], node: int) -> None:
        """A plain material."""
        self.connect(
            self.add("Material", name, "", f"Properties70: {{\n{_row('DiffuseColor', 'Color', *colour)}\n}}"), node
        )

    def skin(self, geometry: int, bones: Sequence[tuple[int, Sequence[int], Sequence[float], Sequence[float]]]) -> int:
        """A skin of bones, each with its vertices, their weights, and where it was bound (x, y, z)."""
        skin = self.add("Deformer", "skin", "Skin")
        self.connect(skin, geometry)
        for bone, vertices, weights, (x, y, z) in bones:
            link = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1)
            mesh = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, -y, -z, 1)
            cluster = self.add(
                "SubDeformer", "cluster", "Cluster", _array("Indexes", vertices), _array("Weights", weights),
                _array("Transform", mesh), _array("TransformLink", link),
            )  # fmt: skip
            self.objects[-1] = self.objects[-1].replace("SubDeformer:", "Deformer:", 1)
            self.connect(cluster, skin)
            self.connect(bone, cluster)
        return skin

    def blend_channel(
        self,
        geometry: int,
        shapes: Sequence[tuple[float, Sequence[int], Sequence[Sequence[float]]]],
        percent: float = 0,
    ) -> int:
        """A channel of shapes, each with the percentage at which it is whole, its vertices and their displacements."""
        blend = self.add("Deformer", "blend", "BlendShape")
        self.connect(blend, geometry)
        channel = self.add(
            "Deformer", "channel", "BlendShapeChannel", "DeformPercent: 0",
            _array("FullWeights", [full for full, *_ in shapes]),
        )  # fmt: skip
        self.connect(channel, blend)
        for place, (_, vertices, displacements) in enumerate(shapes):
            shape = self.add(
                "Geometry", f"shape {place}", "Shape", _array("Indexes", vertices),
                _array("Vertices", [x for moved in displacements for x in moved]),
            )  # fmt: skip
            self.connect(shape, channel)
        return channel

    def stack(self, name: str, begin: float, end: float) -> int:
        """A take of so many seconds, without layers."""
        span = [_row(key, "KTime", round(at * TICKS)) for key, at in (("LocalStart", begin), ("LocalStop", end))]
        self.takes.append(
            f'Take: "{name}" {{\nFileName: "{name}.tak"\nLocalTime: {round(begin * TICKS)},{round(end * TICKS)}\n}}'
        )
        number = self.add("AnimationStack", name, "", "Properties70: {\n" + "\n".join(span) + "\n}")
        self.objects[-1] = self.objects[-1].replace("AnimationStack::", "AnimStack::")
        return number

    def layer(self, stack: int, *rows: tuple[object, ...]) -> int:
        """A layer of a take."""
        found = "\n".join(_row(str(row[0]), str(row[1]), *row[2:]) for row in rows)
        number = self.add("AnimationLayer", "layer", "", f"Properties70: {{\n{found}\n}}")
        self.objects[-1] = self.objects[-1].replace("AnimationLayer::", "AnimLayer::")
        self.connect(number, stack)
        return number

    def animate(
        self, layer: int, node: int, prop: str, keys: Sequence[float], rest: Sequence[float] = (0, 0, 0),
        **curves: Sequence[float],
    ) -> None:  # fmt: skip
        """Curves of a property: values at times `keys` (seconds) for axes x, y, z, or for `d`, straight in between."""
        axes = dict(zip("xyz", rest, strict=True)) if "d" not in curves else {"DeformPercent": 0}
        rows = [_row(f"d|{axis.upper() if len(axis) == 1 else axis}", "Number", value) for axis, value in axes.items()]
        curve_node = self.add("AnimationCurveNode", prop, "", "Properties70: {\n" + "\n".join(rows) + "\n}")
        self.objects[-1] = self.objects[-1].replace("AnimationCurveNode::", "AnimCurveNode::")
        self.connect(curve_node, layer)
        self.connect(curve_node, node, prop)
        for axis, values in curves.items():
            curve = self.add(
                "AnimationCurve", "", "", "Default: 0", "KeyVer: 4009",
                _array("KeyTime", [round(key * TICKS) for key in keys]), _array("KeyValueFloat", values),
                _array("KeyAttrFlags", [4]), _array("KeyAttrDataFloat", [0, 0, 0, 0]),
                _array("KeyAttrRefCount", [len(keys)]),
            )  # fmt: skip
            self.objects[-1] = self.objects[-1].replace("AnimationCurve::", "AnimCurve::")
            self.connect(curve, curve_node, "d|DeformPercent" if axis == "d" else f"d|{axis.upper()}")

    def data(self) -> bytes:
        """The file."""
        up, front = (1, 2) if self.up == "y" else (2, 1)
        axes = (("UpAxis", up), ("UpAxisSign", 1), ("FrontAxis", front), ("FrontAxisSign", 1 if self.up == "y" else -1))
        settings = [_row(name, "int", value) for name, value in (*axes, ("CoordAxis", 0), ("CoordAxisSign", 1))]
        settings += [_row("UnitScaleFactor", "double", self.unit_centimetres)]
        settings += [_row("TimeMode", "enum", TIME_MODES[self.rate])]
        parts = [
            "; FBX 7.4.0 project file",
            "FBXHeaderExtension: {\nFBXHeaderVersion: 1003\nFBXVersion: 7400\n}",
            "GlobalSettings: {\nVersion: 1000\nProperties70: {\n" + "\n".join(settings) + "\n}\n}",
            "Objects: {\n" + "\n".join(self.objects) + "\n}",
            "Connections: {\n" + "\n".join(self.connections) + "\n}",
            'Takes: {\nCurrent: ""\n' + "\n".join(self.takes) + "\n}",
        ]
        return "\n".join(parts).encode()


SQUARE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))


def moving_square(**settings: object) -> FbxText:
    """A square that goes 30 centimetres along x in a second."""
    made = FbxText(**settings)  # type: ignore[arg-type]
    node = made.model("square", subtype="Mesh")
    made.mesh(SQUARE, [(0, 1, 2, 3)], node)
    made.material("red", (0.5, 0.25, 0), node)
    made.animate(made.layer(made.stack("slide", 0, 1)), node, "Lcl Translation", [0, 1], x=[0, 30])
    return made


def bending_strip() -> FbxText:
    """Two squares one above the other, the upper one moved by a bone that turns, the lower one by its parent."""
    made = FbxText()
    hip = made.model("hip", subtype="LimbNode")
    knee = made.model("knee", ("Lcl Translation", "Lcl Translation", 0, 1, 0), parent=hip, subtype="LimbNode")
    node = made.model("strip", subtype="Mesh")
    points = [(x, y, 0) for y in range(3) for x in range(2)]
    geometry = made.mesh(points, [(0, 1, 3, 2), (2, 3, 5, 4)], node)
    made.skin(geometry, [
        (hip, range(4), [1, 1, 0.5, 0.5], (0, 0, 0)), (knee, range(2, 6), [0.5, 0.5, 1, 1], (0, 1, 0)),
    ])  # fmt: skip
    layer = made.layer(made.stack("bend", 0, 1))
    made.animate(layer, knee, "Lcl Rotation", [0, 1], z=[0, 90])
    return made


def blending_square() -> FbxText:
    """A corner that rises to a shape in between and sinks from it to the last one."""
    made = FbxText()
    node = made.model("square", subtype="Mesh")
    geometry = made.mesh(SQUARE, [(0, 1, 2, 3)], node)
    channel = made.blend_channel(geometry, [(50, [2], [(0, 0, 4)]), (100, [2], [(0, 0, 1)])])
    made.animate(made.layer(made.stack("blend", 0, 1)), channel, "DeformPercent", [0, 1], d=[0, 100])
    return made
