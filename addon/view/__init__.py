"""The view and the light: from camera and empty to directions in world space, and places in a 3D view."""
