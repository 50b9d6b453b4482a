"""Solving while the artist works: drags under the mouse, the live warp, and the background thread that both use."""
