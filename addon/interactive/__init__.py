"""Solving while the artist works: drags under the mouse, the live warp, and the background work that both use."""
