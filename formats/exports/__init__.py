"""Files made of a result: one file an export, one table of them.

export_table  the exports by name
game_engines  the programs that import clips
json_document  the whole result as JSON
csv_tables  a row for each segment, or for each frame
webvtt      subtitles for a video
elan        annotations for ELAN
clips_and_key_poses  the uploaded file again, with clips or with key poses
npz_arrays  arrays for NumPy
plot        the energy curve over the segments, as SVG and as PNG
"""
