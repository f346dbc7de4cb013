class_name EditorFileDialog
extends FileDialog
## As much of Godot's own as the add-on needs: there is none outside of the editor.
