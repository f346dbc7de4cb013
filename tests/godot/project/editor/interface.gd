class_name EditorInterface
extends Object
## As much of Godot's own as the add-on needs: there is none outside of the editor.

static var base: Control
static var edited: Node
static var files := Files.new()
static var unsaved := 0


class Files:
	var _scans := 0

	func scan() -> void:
		_scans = 3

	func is_scanning() -> bool:
		_scans -= 1
		return _scans > 0


static func get_base_control() -> Control:
	return base


static func get_edited_scene_root() -> Node:
	return edited


static func get_resource_filesystem() -> Files:
	return files


static func mark_scene_as_unsaved() -> void:
	unsaved += 1
