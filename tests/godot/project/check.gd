extends Node
## The add-on in Godot itself: bakes become materials and nodes, and are updated without doubles.
##
## Prints a line for each check, and at last how many went wrong. `bakes` has the folders `school`, `again` (the same
## with other people) and `floor` (of the floor alone).

const Bake := preload("res://addons/trodden/bake.gd")
const Plugin := preload("res://addons/trodden/plugin.gd")

var _wrong := 0
## What the import of images and scenes gives, by path: as long as they live, `load` gives them.
var _imported: Dictionary[String, Resource] = {}


func _ready() -> void:
	# In its first frame the engine may complain of itself, of an object's number that nobody has set.
	await get_tree().process_frame
	print("checks begin")
	_folders_that_are_no_bakes()
	_a_bake_with_a_scene()
	_a_bake_of_the_floor()
	await _the_menu()
	_dirt_over_own_surfaces()
	print("wrong: %d" % _wrong)


func _right(what: String, right: bool) -> void:
	_wrong += int(not right)
	print("%s  %s" % ["ok " if right else "BAD", what])


func _folders_that_are_no_bakes() -> void:
	DirAccess.make_dir_recursive_absolute("user://empty")
	_right("a folder without a manifest is refused", Bake.new("user://empty").problem.contains("no manifest.json"))
	for text: String in ["", "[]", "{}", '{"generator": "trodden", "format": 1}']:
		_write("user://other/manifest.json", text.to_utf8_buffer())
		_right("'%s' is no manifest" % text, Bake.new("user://other").problem.contains("not the manifest"))
	_write("user://other/manifest.json", '{"generator": "trodden", "format": 9, "floor": {}}'.to_utf8_buffer())
	_right("a later format is refused", Bake.new("user://other/").problem.contains("later version"))


func _a_bake_with_a_scene() -> void:
	_copy("school", "plan")
	var bake := Bake.new("user://plan/")
	_right("%s is a bake" % bake.title(), bake.problem == "" and bake.title() == "plan")
	var world := Node3D.new()
	add_child(world)
	var node := Node3D.new()
	world.add_child(node)
	node.owner = world
	bake.place(node, world)
	var tiles: Array = bake.manifest["floor"]["tiles"]
	var sheets: Array = bake.manifest["walls"]["sheets"]
	var shown := _dressed(node)
	_right("%d tiles and %d sheets are dressed" % [tiles.size(), sheets.size()],
		tiles.size() > 1 and shown.size() == tiles.size() + sheets.size())
	for tile: Dictionary in tiles:
		_check_tile(shown["floor_%d_%d" % [tile["u"], tile["v"]]], tile, bake)
	_check_images(shown["walls_0"], sheets[0], bake)
	_right("tops of walls keep their own", _meshes(node).size() > shown.size())

	# What somebody adds and changes stays.
	var chair := Node3D.new()
	chair.name = "chair"
	node.add_child(chair)
	var material: ORMMaterial3D = shown["floor_0_0"].get_surface_override_material(0)
	material.uv1_scale = Vector3(2, 2, 2)
	ResourceSaver.save(material)
	var before := [_meshes(node).size(), node.get_child_count(), _mean(material)]
	_copy("again", "plan")
	Bake.new("user://plan").place(node, world)
	var after := _dressed(node)
	_right("an update makes no doubles", [_meshes(node).size(), node.get_child_count()] == before.slice(0, 2))
	var updated: ORMMaterial3D = after["floor_0_0"].get_surface_override_material(0)
	_right("the floor is as it was baked last", _mean(updated) != before[2] and _is_file(
		updated.albedo_texture, "res://bakes/again".path_join(tiles[0]["basecolor"])))
	_right("changes of a material stay", updated.uv1_scale == Vector3(2, 2, 2) and updated == material)
	_right("other nodes stay", chair.get_parent() == node)

	# Saved and opened again.
	var packed := PackedScene.new()
	_right("the scene can be saved", packed.pack(world) == OK)
	var opened := packed.instantiate()
	_right("with its materials", _dressed(opened).size() == after.size())
	opened.free()

	# Of the floor alone the next time.
	DirAccess.remove_absolute("user://plan/scene.glb")
	Bake.new("user://plan").place(node, world)
	_right("planes take the place of the scene", _meshes(node).size() == tiles.size())
	world.free()


func _a_bake_of_the_floor() -> void:
	_copy("floor", "floor")
	var bake := Bake.new("user://floor")
	var world := Node3D.new()
	add_child(world)
	bake.place(world, world)
	bake.place(world, world)
	var shown := _dressed(world)
	var tiles: Array = bake.manifest["floor"]["tiles"]
	_right("a floor alone is %d planes" % tiles.size(), shown.size() == tiles.size() and _meshes(world).size() == tiles.size())
	for tile: Dictionary in tiles:
		_check_tile(shown["floor_%d_%d" % [tile["u"], tile["v"]]], tile, bake)
	world.free()


## The bake's own shaders, and the script that makes materials with them: it is a script of the editor, which is not here.
func _dirt_over_own_surfaces() -> void:
	_copy("school", "plan")
	var bake := Bake.new("user://plan")
	var script := GDScript.new()
	script.source_code = FileAccess.get_file_as_string("res://bakes/school/shaders/trodden_setup.gd").replace(
		"extends EditorScript", "extends RefCounted")
	_right("the bake's script can be read", script.reload() == OK)
	script.new().make(bake.folder, bake.manifest)
	var tiles: Array = bake.manifest["floor"]["tiles"]
	var sheets: Array = bake.manifest["walls"]["sheets"]
	var names := PackedStringArray()
	for tile: Dictionary in tiles:
		names.append("floor_%d_%d" % [tile["u"], tile["v"]])
	for number in sheets.size():
		names.append("walls_%d" % number)
	for mesh in names:
		var material: ShaderMaterial = load(bake.folder.path_join("materials/dirt_%s.tres" % mesh))
		# A shader that does not compile has no uniforms.
		var uniforms := material.shader.get_shader_uniform_list().map(func(each: Dictionary) -> String: return each["name"])
		var second := "wear" if mesh.begins_with("floor") else "splash"
		_right("dirt of %s: a shader with %d uniforms" % [mesh, uniforms.size()], uniforms.has("mask") and uniforms.size() > 10
			and material.get_shader_parameter("mask") is Texture2D and material.get_shader_parameter(second) is Texture2D)


## The entries of the menu, in a stand-in for the editor.
func _the_menu() -> void:
	EditorInterface.base = Control.new()
	add_child(EditorInterface.base)
	var plugin: Node = Plugin.new()
	add_child(plugin)
	var entries: Dictionary[String, Callable] = plugin.entries
	_right("the menu has two entries: %s" % [entries.keys()], entries.size() == 2)
	var message: AcceptDialog = EditorInterface.base.get_child(1)
	_copy("school", "plan")
	await plugin.import_bake("user://plan")
	_right("without a scene it says what to do: %s" % message.dialog_text, message.dialog_text.begins_with("Open a 3D"))

	var world := Node3D.new()
	add_child(world)
	EditorInterface.edited = world
	await entries[Plugin.UPDATE].call()
	_right("nothing to update: %s" % message.dialog_text, message.dialog_text.contains(Plugin.IMPORT))
	await plugin.import_bake("user://empty")
	_right("no bake: %s" % message.dialog_text, message.dialog_text.contains("no manifest.json"))
	await plugin.import_bake("user://plan")
	await plugin.import_bake("user://floor")
	await plugin.import_bake("user://plan/")
	var names := world.get_children().map(func(node: Node) -> String: return node.name)
	_right("two bakes are two nodes: %s" % [names], names == ["plan", "floor"] and EditorInterface.unsaved == 3)
	var again := world.get_child(0).duplicate()
	world.add_child(again)
	var meshes := _meshes(world).size()
	var before := _look(world.get_child(0))
	_copy("again", "plan")
	await entries[Plugin.UPDATE].call()
	_right("an update of all makes no doubles", _meshes(world).size() == meshes and world.get_child_count() == 3)
	_right("and reaches every one", _look(again) == _look(world.get_child(0)) and _look(again) != before)
	remove_child(plugin)
	_right("nothing stays in the menu", entries.is_empty())
	plugin.free()
	world.free()


func _look(node: Node) -> int:
	return _mean(_dressed(node)["floor_0_0"].get_surface_override_material(0))


## A tile's mesh shows the tile's images where the manifest says that they lie.
func _check_tile(shown: MeshInstance3D, tile: Dictionary, bake: Bake) -> void:
	_check_images(shown, tile, bake)
	var least := Vector2(tile["min_m"][0], tile["min_m"][1])
	var size := Vector2(tile["max_m"][0], tile["max_m"][1]) - least
	var arrays := shown.mesh.surface_get_arrays(0)
	var off := 0.0
	for n in arrays[Mesh.ARRAY_VERTEX].size():
		var place := shown.global_transform * (arrays[Mesh.ARRAY_VERTEX][n] as Vector3)
		var plan := Vector2(place.x, -place.z) - least
		var wanted := Vector2(plan.x / size.x, 1.0 - plan.y / size.y)
		off = maxf(off, maxf(wanted.distance_to(arrays[Mesh.ARRAY_TEX_UV][n]), absf(place.y)))
	_right("%s lies where the manifest says, to %.6f" % [shown.name, off], off < 1e-4)


func _check_images(shown: MeshInstance3D, images: Dictionary, bake: Bake) -> void:
	var material: ORMMaterial3D = shown.get_surface_override_material(0)
	var right := _is_file(material.albedo_texture, bake.folder.path_join(images["basecolor"]))
	right = right and _is_file(material.orm_texture, bake.folder.path_join(images["orm"]))
	right = right and material.normal_enabled and _is_file(material.normal_texture, bake.folder.path_join(images["normal"]))
	_right("%s has colour, ORM and normals of its own" % shown.name, right and not material.texture_repeat)


func _is_file(texture: Texture2D, path: String) -> bool:
	return texture.get_image().get_data() == Image.load_from_file(path).get_data()


func _mean(material: BaseMaterial3D) -> int:
	return hash(material.albedo_texture.get_image().get_data())


func _meshes(node: Node) -> Array[Node]:
	return node.find_children("*", "MeshInstance3D", true, false)


## Meshes with a material of their own, by name without the colliders' ending.
func _dressed(node: Node) -> Dictionary[String, MeshInstance3D]:
	var found: Dictionary[String, MeshInstance3D] = {}
	for mesh: MeshInstance3D in _meshes(node):
		if mesh.get_surface_override_material(0):
			found[String(mesh.name).trim_suffix("-col")] = mesh
	return found


## Copies the files of a bake out of the package, and imports its images.
func _copy(bake: String, to: String) -> void:
	var from := "res://bakes".path_join(bake)
	var manifest: Dictionary = JSON.parse_string(FileAccess.get_file_as_string(from.path_join("manifest.json")))
	for file: String in manifest["files"]:
		if FileAccess.file_exists(from.path_join(file)):
			var path := "user://".path_join(to).path_join(file)
			_write(path, FileAccess.get_file_as_bytes(from.path_join(file)))
			if file.ends_with(".png"):
				_import(path, ImageTexture.create_from_image(Image.load_from_file(path)))
	if FileAccess.file_exists(from.path_join(Bake.SCENE)):
		_import_scene("user://".path_join(to).path_join(Bake.SCENE))


func _import_scene(path: String) -> void:
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	document.append_from_file(path, state)
	var made := document.generate_scene(state)
	for node in made.find_children("*", "", true, false):
		node.owner = made
	var packed := PackedScene.new()
	packed.pack(made)
	made.free()
	_import(path, packed)


func _import(path: String, resource: Resource) -> void:
	_imported[path] = resource
	resource.take_over_path(path)


func _write(path: String, bytes: PackedByteArray) -> void:
	DirAccess.make_dir_recursive_absolute(path.get_base_dir())
	FileAccess.open(path, FileAccess.WRITE).store_buffer(bytes)
