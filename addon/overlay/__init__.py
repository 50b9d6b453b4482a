"""What the artist sees: stripes over the shaded model, drawn from the reflection function that the solver optimizes."""
