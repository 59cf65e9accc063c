# Loops and plain names of Caesura's clips, set at the import. Set as Import Script of a .glb. Where the .json of the same name
# lies beside it, motions that it marks as loops do loop too.
@tool
extends EditorScenePostImport

const SUFFIX := "-loop"


func _post_import(scene: Node) -> Object:
	var clips := _clips(get_source_file())
	for player: AnimationPlayer in scene.find_children("*", "AnimationPlayer"):
		for library_name in player.get_animation_library_list():
			_prepare(player.get_animation_library(library_name), clips)
	return scene


# What the GLB says of each of its clips, and whether it loops, by the name without the ending.
func _clips(path: String) -> Dictionary:
	var file := FileAccess.open(path, FileAccess.READ)
	file.seek(12)  # behind magic, version and length
	var length := file.get_32()
	file.seek(20)
	var root: Dictionary = JSON.parse_string(file.get_buffer(length).get_string_from_utf8())
	var segments := _segments(path.get_basename() + ".json")
	var found := {}
	for animation: Dictionary in root.get("animations", []):
		var clip: Dictionary = animation.get("extras", {}).get("caesura", {})
		if clip.is_empty():
			continue
		var name: String = animation["name"]
		clip["loop"] = name.ends_with(SUFFIX)
		for segment: Dictionary in segments:
			if segment["start"] <= clip["start"] and clip["start"] < segment["end"]:
				clip["loop"] = clip["loop"] or segment.get("loop", false)
				clip["confidence"] = segment.get("confidence")
		found[name.trim_suffix(SUFFIX)] = clip
	return found


func _segments(path: String) -> Array:
	if not FileAccess.file_exists(path):
		return []
	var result: Variant = JSON.parse_string(FileAccess.get_file_as_string(path))
	return result.get("segments", []) if result is Dictionary else []


func _prepare(library: AnimationLibrary, clips: Dictionary) -> void:
	for name: StringName in library.get_animation_list():
		var plain := String(name).trim_suffix(SUFFIX)
		if not clips.has(plain):
			continue
		var animation := library.get_animation(name)
		animation.loop_mode = Animation.LOOP_LINEAR if clips[plain]["loop"] else Animation.LOOP_NONE
		animation.set_meta("caesura", clips[plain])
		if plain != String(name) and not library.has_animation(plain):
			library.rename_animation(name, plain)
