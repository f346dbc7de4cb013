@tool
extends RefCounted
## A bake of trodden in the project: its materials, and the nodes that show it.

const MANIFEST := "manifest.json"
const SCENE := "scene.glb"
## Version of the manifest that is understood.
const FORMAT := 1
## Metadata of the node under which a bake stands: the bake's folder.
const FOLDER_META := &"trodden_bake"
## Metadata of the nodes that stand for it, which an update replaces: the scene's file, or nothing for planes.
const MADE_META := &"trodden_made"
## Ending of the names of colliders, which Godot's import takes off.
const COLLIDER := "-col"

## Folder of the bake, as `res://bakes/station`.
var folder: String
var manifest: Dictionary
## Why it cannot be shown; empty if it can.
var problem := ""


func _init(of_folder: String) -> void:
	folder = of_folder.trim_suffix("/")
	var path := folder.path_join(MANIFEST)
	if not FileAccess.file_exists(path):
		problem = "%s: this folder is not a bake: it has no %s" % [folder, MANIFEST]
		return
	var json := JSON.new()
	var read: Variant = json.data if json.parse(FileAccess.get_file_as_string(path)) == OK else null
	if not read is Dictionary or read.get("generator") != "trodden" or not read.get("floor") is Dictionary:
		problem = "%s: this is not the manifest of a bake" % path
		return
	if int(read.get("format", FORMAT)) > FORMAT:
		problem = "%s: a later version of trodden wrote it; this add-on reads format %d" % [path, FORMAT]
		return
	manifest = read


## The last part of the folder's name.
func title() -> String:
	return folder.get_file()


## Materials by the names of the meshes of scene.glb: `floor_U_V` of each tile, `walls_N` of each sheet.
##
## They are kept in `materials` of the bake. A material that is there gets the textures, the rest of it stays.
func materials() -> Dictionary[String, BaseMaterial3D]:
	var found: Dictionary[String, BaseMaterial3D] = {}
	for tile: Dictionary in manifest["floor"]["tiles"]:
		var name := "floor_%d_%d" % [tile["u"], tile["v"]]
		found[name] = _material(name, tile)
	# A bake of the floor alone has no walls.
	var walls: Variant = manifest.get("walls")
	if walls is Dictionary:
		var sheets: Array = walls["sheets"]
		for number in sheets.size():
			var name := "walls_%d" % number
			found[name] = _material(name, sheets[number])
	return found


## Shows the bake under a node: scene.glb, or a plane for each tile of the floor if there is none.
##
## What an earlier call put there is replaced, or stays if it is the same scene. `scene_root` is the root of the scene
## in which all of it is saved.
func place(parent: Node3D, scene_root: Node) -> void:
	var own := materials()
	var file := folder.path_join(SCENE)
	var shown: Node3D = null
	for child in parent.get_children():
		if not child.has_meta(MADE_META):
			continue
		if shown == null and child.get_meta(MADE_META) == file and has_scene():
			shown = child
		else:
			parent.remove_child(child)
			child.queue_free()
	parent.set_meta(FOLDER_META, folder)
	if shown == null:
		shown = scene() if has_scene() else _planes()
		shown.set_meta(MADE_META, file if has_scene() else "")
		parent.add_child(shown)
		shown.owner = scene_root
		if not has_scene():
			for plane in shown.get_children():
				plane.owner = scene_root
	if has_scene():
		# Without this the materials would not be saved with the scene.
		scene_root.set_editable_instance(shown, true)
	_dress(shown, own)


## Whether the bake has a 3D scene; a bake of the floor alone has none.
func has_scene() -> bool:
	return FileAccess.file_exists(folder.path_join(SCENE))


## A new instance of scene.glb.
func scene() -> Node3D:
	return (load(folder.path_join(SCENE)) as PackedScene).instantiate()


## The texture of a file of the bake.
func texture(file: String) -> Texture2D:
	return load(folder.path_join(file))


func _material(name: String, images: Dictionary) -> BaseMaterial3D:
	var path := folder.path_join("materials").path_join(name + ".tres")
	var material: BaseMaterial3D = null
	if FileAccess.file_exists(path):
		material = load(path) as BaseMaterial3D
	if material == null:
		material = ORMMaterial3D.new()
		material.resource_name = name
		# Colour goes on a few pixels beyond floor and strips: what lies opposite must not show.
		material.texture_repeat = false
		material.ao_enabled = true
	material.albedo_texture = texture(images["basecolor"])
	if material is ORMMaterial3D:
		material.orm_texture = texture(images["orm"])
	# Godot wants green to point up, as all targets but Unreal have it.
	var green_up: bool = str(manifest["target"]["normals"]).begins_with("green points up")
	material.normal_enabled = images.has("normal") and green_up
	if material.normal_enabled:
		material.normal_texture = texture(images["normal"])
	DirAccess.make_dir_recursive_absolute(path.get_base_dir())
	var error := ResourceSaver.save(material, path)
	if error != OK:
		push_error("%s cannot be written: %s" % [path, error_string(error)])
	material.take_over_path(path)
	return material


## A plane for each tile of the floor, where it lies in the plan: x to the right, z down the plan, metres.
func _planes() -> Node3D:
	var planes := Node3D.new()
	planes.name = "floor"
	for tile: Dictionary in manifest["floor"]["tiles"]:
		var least := Vector2(tile["min_m"][0], tile["min_m"][1])
		var most := Vector2(tile["max_m"][0], tile["max_m"][1])
		var plane := PlaneMesh.new()
		plane.size = most - least
		var shown := MeshInstance3D.new()
		shown.name = "floor_%d_%d" % [tile["u"], tile["v"]]
		shown.mesh = plane
		shown.position = Vector3((least.x + most.x) / 2.0, 0.0, -(least.y + most.y) / 2.0)
		planes.add_child(shown)
	return planes


## Gives the meshes below a node their materials, by name.
func _dress(node: Node, own: Dictionary[String, BaseMaterial3D]) -> void:
	var name := String(node.name).trim_suffix(COLLIDER)
	if node is MeshInstance3D and own.has(name):
		var shown: MeshInstance3D = node
		for surface in shown.mesh.get_surface_count():
			shown.set_surface_override_material(surface, own[name])
	for child in node.get_children():
		_dress(child, own)
