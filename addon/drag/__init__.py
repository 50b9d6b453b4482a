"""Tools under the mouse: how a drag sets values, and how the panel follows while a thread solves."""
