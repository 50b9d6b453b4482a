"""Makes faucet.blend beside this script: ./run samples"""
import pathlib

import checkout
import panel_shapes
import studio

HERE = pathlib.Path(__file__).resolve().parent

SHOT = studio.Shot(view_direction=(0.0, -1.0, 0.0), line_direction=(0.95, 0.0, 0.31), centre=(0.075, 0.0, 0.115),
                   width=0.30, lamp=(0.2, -0.05, 0.25), stripes=studio.Stripes(count=12), length=0.03,
                   colour=(0.80, 0.80, 0.82))


def main() -> None:
    checkout.enable_add_on()
    V, quads, _ = panel_shapes.faucet()
    faucet = studio.stage("Faucet", V, quads, panel_shapes.faucet_inside(), SHOT)
    studio.save(faucet, str(HERE / "faucet.blend"))


main()
