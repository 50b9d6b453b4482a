"""Looks of the stripes that come with the add-on, by the names of the settings in ui/stripe_properties.py."""

Setting = str | int | float | tuple[float, float, float, float]

WHITE, BLACK = (0.9, 0.93, 1.0, 0.9), (0.01, 0.012, 0.016, 0.9)  # over the mesh, which shines through


def build_bands(mode: str, count: int, width: float, softness: float) -> dict[str, Setting]:
    return {"mode": mode, "count": count, "width": width, "softness": softness, "color": WHITE, "gap_color": BLACK}


LOOKS = {
    'ZEBRA': ("Zebra", "Light and dark in equal parts, as the settings begin", build_bands('REFLECTION', 60, 0.5, 0.1)),
    'FINE': ("Fine Zebra", "Twice as many lines, for small flaws", build_bands('REFLECTION', 120, 0.5, 0.1)),
    'TUBES': ("Light Tubes", "Few narrow lights, as in an inspection tunnel", build_bands('REFLECTION', 24, 0.15, 0.3)),
    'SOFT': ("Soft Boxes", "Wide lights that fade, for the large shape", build_bands('REFLECTION', 16, 0.5, 1.0)),
    'HIGHLIGHT': ("Highlight Lines", "They stay as you look around", build_bands('HIGHLIGHT', 60, 0.5, 0.1)),
    'ISOPHOTES': ("Isophotes", "Equal angle to the light", build_bands('ISOPHOTE', 60, 0.5, 0.1)),
}
