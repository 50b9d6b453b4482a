"""The user interface: properties, panels, menus, gizmos, tools of the toolbar, keys and preferences."""
