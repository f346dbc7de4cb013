@tool
extends EditorScript
# Makes a material for each floor tile and each sheet of walls of this bake: the dirt over your own floor, in world space,
# and over your own walls. Godot 4.
#
# Copy the whole bake into the project and wait for the import (the .import files beside the images set: no colour
# conversion for masks, full size, mip-maps, alpha as it is), open this script and choose File > Run. Materials
# appear in `materials/` of the bake: dirt_floor_U_V and dirt_walls_N, for the meshes of scene.glb of these names. A floor
# mesh that spans several tiles has to be cut where tiles meet, as the one in scene.glb is.

var _bake: String


func _run() -> void:
	var bake: String = (get_script() as Script).resource_path.get_base_dir().get_base_dir()
	var manifest = JSON.parse_string(FileAccess.get_file_as_string(bake.path_join("manifest.json")))
	if manifest == null:
		push_error("There is no manifest.json in %s" % bake)
		return
	make(bake, manifest)
	EditorInterface.get_resource_filesystem().scan()


func make(bake: String, manifest: Dictionary) -> void:
	_bake = bake
	DirAccess.make_dir_recursive_absolute(_bake.path_join("materials"))
	for tile in manifest["floor"]["tiles"]:
		var world: Dictionary = tile["world"]
		_material("floor", "floor_%d_%d" % [tile["u"], tile["v"]], tile, ["mask", "wear"], {
			"origin": Vector2(world["origin"][0], world["origin"][1]), "size": Vector2(world["size"][0], world["size"][1])})
	var walls = manifest.get("walls")
	if walls:
		for n in walls["sheets"].size():
			var sheet: Dictionary = walls["sheets"][n]
			var sheet_m := Vector2(sheet["width_px"], sheet["height_px"]) / float(walls["texels_per_metre"])
			_material("wall", "walls_%d" % n, sheet, ["mask", "splash"], {"sheet_m": sheet_m})


func _material(covered: String, mesh: String, entry: Dictionary, images: Array, values: Dictionary) -> void:
	var material := ShaderMaterial.new()
	material.shader = load(_bake.path_join("shaders/trodden_%s.gdshader" % covered))
	for image in images:
		if entry.has(image):
			material.set_shader_parameter(image, load(_bake.path_join(entry[image])))
	for value in values:
		material.set_shader_parameter(value, values[value])
	var path := _bake.path_join("materials/dirt_%s.tres" % mesh)
	var error := ResourceSaver.save(material, path)
	if error != OK:
		push_error("%s cannot be written: %s" % [path, error_string(error)])
