"""Makes faucet.blend beside this script: blender -b --factory-startup -P blend_samples/make_faucet.py"""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import checkout  # noqa: E402  (Blender puts no script's own folder on the path)
import panel_shapes  # noqa: E402
import studio  # noqa: E402

SHOT = studio.Shot(view_direction=(0.0, -1.0, 0.0), line_direction=(0.95, 0.0, 0.31), centre=(0.075, 0.0, 0.115),
                   width=0.30, lamp=(0.2, -0.05, 0.25), stripes=studio.Stripes(count=12), length=0.03,
                   colour=(0.80, 0.80, 0.82))


def main() -> None:
    checkout.enable_add_on()
    V, quads, _ = panel_shapes.faucet()
    faucet = studio.stage("Faucet", V, quads, panel_shapes.faucet_inside(), SHOT)
    studio.save(faucet, str(HERE / "faucet.blend"))


main()
