"""Readers that are libraries of native code: each reads its file in a process of its own, and hands arrays back.

Such a library may crash, hang or fill the memory, and then its process ends alone. What it was reading becomes an
error that says so.

reader_process   the process, as the one that starts it sees it: its answer, or why it ended
reader_answer    what a reader answers: a GLB, or frames of vertices
reader_main      what runs in the process
confinement      what the process may not do: its limits, and no network, no other file, no other program
finite_numbers   what of a file glTF can hold
landlock, seccomp  two ways in which Linux enforces that
read_as_gltf, read_as_vertices  what a reader's door does: a file in, an animation out
fbx, alembic, usd  the readers, one folder a library
"""
