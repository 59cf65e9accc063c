"""The motions of a take in Blender: found by a Caesura service, shown as markers, cut into named actions.

Without bpy, and so importable anywhere:

service_client    the calls of the service's API
local_service     a service of one's own, started by the command `caesura`
skeleton_file     the poses of an armature as GLB
vertex_file       the vertices of a mesh as NPZ
segments          segments, the markers that say where they begin, and the revision that they are
key_cut           the keys of an F-curve between two frames
sliced_work       work in slices of bounded time, and threads that it waits for

With bpy:

preferences, properties   the service, and what a scene keeps of its result
frame_capture             frames evaluated one by one, in a scene of their own
markers, actions          what a result becomes
motions                   the steps of finding, changing and saving
running_work              what runs now, and its timer
operators, panel, timeline_bands   what a person sees
"""


def register() -> None:
    """Blender calls this when the add-on is enabled."""
    from . import registration

    registration.register()


def unregister() -> None:
    """Blender calls this when the add-on is disabled, and when it ends."""
    from . import registration

    registration.unregister()
