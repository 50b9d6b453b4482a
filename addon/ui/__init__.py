"""What the artist sees beside the 3D view: properties, panels, menus, keys and preferences."""
