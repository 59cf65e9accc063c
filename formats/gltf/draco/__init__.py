"""Geometry compressed by Draco (KHR_draco_mesh_compression): its header judged, then decoded by the library."""
