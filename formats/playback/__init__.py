"""What the page plays: a model, and how strained its surface is at every frame.

    from caesura.formats.playback.playback_files import playback
    playback(animation, analysis, threads=…, progress=…) -> Playback(document, model, strain, materials)

A glTF plays as itself: `model` is a plain copy that three.js skins on the GPU (`plain_copy`). A vertex sequence
plays from blocks of 32 frames (`vertex_blocks`). `strain` is one byte per patch and frame in blocks of the same
form (`strain_blocks`), or None where there are no triangles. `materials` is a GLB of the model's materials with
their images (`materials`), or None where it has no image. Both streams are written as they are made, so memory
does not grow with the length of the take, and both are read by HTTP Range: the page fetches what it shows.

The two streams depend only on the take and the heavy parameters: one copy serves every cut of an analysis.
The worker writes each stream to a blob of its own and keeps `document` beside their keys. The service answers
`GET /v1/segmentations/{id}/viewer` with that document and the two addresses, whatever they are:

    {"kind": "gltf" | "vertices",          how to read `model`
     "model": "…/viewer/model",            bytes, with Range (206) and Accept-Ranges
     "strain": "…/viewer/strain" | null,   likewise
     "materials": "…/viewer/materials" | null,  likewise
     "frames": 917, "frame_rate": 30.0, "start_seconds": 0.0,
     "vertices": 1728, "triangles": 576,   of what is shown (a vertex sequence may be decimated)
     "skeleton": false,                    true: no mesh, the page draws the bones
     "patches": 128}                       of the strain; 0 where there is none

and answers 409 (`not-finished`) while they are not there yet: the page shows the curve without the figure.
"""
