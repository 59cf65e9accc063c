"""The preferences: which service, or which command starts one."""

import bpy

NETWORK = (
    "Sending needs online access: turn on Preferences > System > Network > Allow Online Access, or use a local service."
)


class CaesuraPreferences(bpy.types.AddonPreferences):
    """Where takes are sent. The key is stored with the user's preferences, and never in a file of work."""

    bl_idname = __package__

    where: bpy.props.EnumProperty(
        name="Service",
        items=(
            ("LOCAL", "On this machine", "Start the command caesura when it is needed, and end it with Blender"),
            ("ADDRESS", "At an address", "Use a service that runs already"),
        ),
        default="LOCAL",
    )
    command: bpy.props.StringProperty(
        name="Command", description="The command caesura; empty: the one on the PATH", subtype="FILE_PATH"
    )
    address: bpy.props.StringProperty(name="Address", default="http://localhost:8000")
    key: bpy.props.StringProperty(name="Key", description="Where the service wants one", subtype="PASSWORD")

    def draw(self, _context: bpy.types.Context) -> None:
        """Show what belongs to the choice."""
        self.layout.prop(self, "where", expand=True)
        for name in ("command",) if self.where == "LOCAL" else ("address", "key"):
            self.layout.prop(self, name)
        away = self.address.startswith("http:") and not any(host in self.address for host in ("localhost", "127.0.0.1"))
        if self.where == "ADDRESS" and self.key and away:
            self.layout.label(text="Over http anybody on the way can read the key: use https.", icon="ERROR")


def preferences(context: bpy.types.Context) -> CaesuraPreferences:
    """Those of this add-on."""
    return context.preferences.addons[__package__].preferences


def online_access() -> bool:
    """Whether Blender's user lets add-ons use the network."""
    return getattr(bpy.app, "online_access", True)
