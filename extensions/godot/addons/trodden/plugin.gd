@tool
extends EditorPlugin
## Two entries in Project > Tools: bring a bake of trodden into the open scene, and update those that are in it.

const Bake := preload("bake.gd")
const IMPORT := "Trodden: import bake..."
const UPDATE := "Trodden: update bakes"

var _folders: EditorFileDialog
var _message: AcceptDialog


func _enter_tree() -> void:
	_folders = EditorFileDialog.new()
	_folders.file_mode = EditorFileDialog.FILE_MODE_OPEN_DIR
	_folders.access = EditorFileDialog.ACCESS_RESOURCES
	_folders.title = "Folder of a bake, with its manifest.json"
	_folders.dir_selected.connect(import_bake)
	_message = AcceptDialog.new()
	_message.title = "Trodden"
	for window: Window in [_folders, _message]:
		EditorInterface.get_base_control().add_child(window)
	add_tool_menu_item(IMPORT, func() -> void: _folders.popup_centered_ratio(0.5))
	add_tool_menu_item(UPDATE, update_bakes)


func _exit_tree() -> void:
	remove_tool_menu_item(IMPORT)
	remove_tool_menu_item(UPDATE)
	_folders.queue_free()
	_message.queue_free()


## Shows the bake of a folder in the open scene; updates it if it is there.
func import_bake(folder: String) -> void:
	var root := EditorInterface.get_edited_scene_root()
	if root == null:
		_tell("Open a 3D scene first: the bake becomes a node of it.")
		return
	await _files_are_imported()
	var bake := Bake.new(folder)
	if bake.problem:
		_tell(bake.problem)
		return
	var nodes := _bakes_below(root).filter(
		func(node: Node3D) -> bool: return node.get_meta(Bake.FOLDER_META) == bake.folder
	)
	if nodes.is_empty():
		var node := Node3D.new()
		node.name = bake.title()
		root.add_child(node, true)
		node.owner = root
		nodes.append(node)
	for node: Node3D in nodes:
		bake.place(node, root)
	EditorInterface.mark_scene_as_unsaved()


## Updates all bakes of the open scene after they were baked again.
func update_bakes() -> void:
	var root := EditorInterface.get_edited_scene_root()
	var folders: Dictionary[String, bool] = {}
	for node in _bakes_below(root) if root else []:
		folders[node.get_meta(Bake.FOLDER_META)] = true
	if folders.is_empty():
		_tell("The open scene shows no bake. %s brings one in." % IMPORT)
	for folder in folders:
		await import_bake(folder)


func _bakes_below(node: Node) -> Array[Node3D]:
	var found: Array[Node3D] = []
	if node is Node3D and node.has_meta(Bake.FOLDER_META):
		found.append(node)
	for child in node.get_children():
		found.append_array(_bakes_below(child))
	return found


## Waits until the editor has seen and imported all files of the project.
func _files_are_imported() -> void:
	var files := EditorInterface.get_resource_filesystem()
	files.scan()
	while files.is_scanning():
		await get_tree().process_frame
	await get_tree().process_frame


func _tell(text: String) -> void:
	_message.dialog_text = text
	_message.popup_centered()
