"""Keys, F-curves and drivers of kept and of baked handles."""
