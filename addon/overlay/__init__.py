"""The overlay: stripes over the shaded mesh, drawn by the reflection function that the solver optimizes."""
