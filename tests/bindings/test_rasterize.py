"""Triangles drawn into a picture: each pixel has the nearest one over its middle, and where in it that is."""
import numpy as np
import pytest
import reflines


def test_each_pixel_has_the_triangle_over_its_middle_and_the_nearest_of_several() -> None:
    points = np.array([[0.0, 0.0, 0.0], [8.0, 0.0, 0.0], [0.0, 6.0, 0.0], [2.0, 1.0, -1.0], [2.0, 5.0, 3.0],
                       [6.0, 1.0, 3.0]])
    F = np.array([[0, 1, 2], [3, 4, 5]])  # the second one the other way round
    triangle, second, third = reflines.rasterize(points, F, width=9, height=7)
    y, x = np.mgrid[:7, :9] + 0.5
    large, small = x / 8 + y / 6 <= 1, (x >= 2) & (y >= 1) & ((x - 2) + (y - 1) <= 4)
    assert np.array_equal(triangle >= 0, large | small)
    near = -1.0 + (x - 2) + (y - 1) > 0.0
    assert np.array_equal(triangle == 1, small & (near | ~large))
    own = triangle == 0
    assert np.allclose(second[own], (x / 8)[own]) and np.allclose(third[own], (y / 6)[own])
    assert not second[triangle < 0].any()


def test_what_lies_beside_the_picture_is_cut_off() -> None:
    points = np.array([[-1e12, -1e12, 0.0], [1e12, -1e12, 0.0], [0.0, 1e12, 0.0], [3.0, 3.0, 0.0]])
    F = np.array([[0, 1, 2], [3, 3, 3]])
    assert not reflines.rasterize(points, F, width=5, height=4)[0].any()
    assert (reflines.rasterize(points + (100.0, 0.0, 0.0), F[1:], width=5, height=4)[0] == -1).all()


@pytest.mark.parametrize(("changed", "sentence"), [
    ({"width": 0}, "a width and a height"), ({"width": 1 << 20, "height": 1 << 20}, "67 million"),
    ({"F": [[0, 1, 7]]}, "7"), ({"points": np.full((3, 3), np.nan)}, "no finite number"),
])
def test_bad_pictures_get_a_sentence(changed: dict, sentence: str) -> None:
    with pytest.raises(reflines.InvalidInput, match=sentence):
        reflines.rasterize(**{"points": np.eye(3), "F": [[0, 1, 2]], "width": 4, "height": 4, **changed})
