@tool
extends EditorScript
# Makes a material for each floor tile of this bake: the dirt over your own floor, in world space. Godot 4.
#
# Copy the whole bake into the project and wait for the import (the .import files beside the images set: no colour
# conversion for masks, full size, mip-maps, alpha as it is), open this script and choose File > Run. Materials
# appear in `materials/` of the bake. A floor mesh that spans several tiles has to be cut where tiles meet, as the
# one in scene.glb is.


func _run() -> void:
	var bake: String = (get_script() as Script).resource_path.get_base_dir().get_base_dir()
	var manifest = JSON.parse_string(FileAccess.get_file_as_string(bake.path_join("manifest.json")))
	if manifest == null:
		push_error("There is no manifest.json in %s" % bake)
		return
	var folder := bake.path_join("materials")
	DirAccess.make_dir_recursive_absolute(folder)
	var shader: Shader = load(bake.path_join("shaders/trodden_floor.gdshader"))
	for tile in manifest["floor"]["tiles"]:
		var material := ShaderMaterial.new()
		material.shader = shader
		material.set_shader_parameter("mask", load(bake.path_join(tile["mask"])))
		if tile.has("wear"):
			material.set_shader_parameter("wear", load(bake.path_join(tile["wear"])))
		material.set_shader_parameter("origin", Vector2(tile["world"]["origin"][0], tile["world"]["origin"][1]))
		material.set_shader_parameter("size", Vector2(tile["world"]["size"][0], tile["world"]["size"][1]))
		var path := folder.path_join("floor_u%d_v%d.tres" % [tile["u"], tile["v"]])
		var error := ResourceSaver.save(material, path)
		if error != OK:
			push_error("%s cannot be written: %s" % [path, error_string(error)])
	EditorInterface.get_resource_filesystem().scan()
