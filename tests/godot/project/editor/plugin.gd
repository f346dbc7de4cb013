class_name EditorPlugin
extends Node
## As much of Godot's own as the add-on needs: there is none outside of the editor.

var entries: Dictionary[String, Callable] = {}


func add_tool_menu_item(title: String, action: Callable) -> void:
	entries[title] = action


func remove_tool_menu_item(title: String) -> void:
	entries.erase(title)
