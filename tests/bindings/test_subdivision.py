"""reflines.Subdivision as Python sees it: what it computes is tested natively and against Blender's modifier."""
import numpy as np
import pytest
import reflines

V = np.array([[x, y, np.sin(x + 2.0 * y)] for y in range(4) for x in range(4)], float)
CORNERS = [4 * y + x for y in range(3) for x in range(3)]
FACES = np.array([[a, a + 1, a + 5, a + 4] for a in CORNERS])
OFFSETS = np.arange(0, 37, 4)


def grid(**settings: object) -> reflines.Subdivision:
    return reflines.Subdivision(OFFSETS, FACES.ravel(), **{"vertices": 16} | settings)


def test_shapes_and_defaults() -> None:
    result = grid()
    assert result.faces.shape == (9 * 16, 4)
    assert np.array_equal(np.bincount(result.face_parent), np.full(9, 16))
    assert result.positions(V).shape == result.normals(V).shape == (13 * 13, 3)
    assert np.allclose(np.linalg.norm(result.normals(V), axis=1), 1)
    assert result.faces.max() == 13 * 13 - 1


def test_positions_are_the_matrix_times_the_cage() -> None:
    result = grid(level=3, limit=False)
    data, indices, indptr = result.matrix()
    S = np.zeros((len(indptr) - 1, 16))
    S[np.repeat(np.arange(len(S)), np.diff(indptr)), indices] = data
    assert np.allclose(S @ V, result.positions(V), rtol=0, atol=1e-14)
    assert np.allclose(S.sum(axis=1), 1, rtol=0, atol=1e-14)


def test_any_integers_and_reals_will_do() -> None:
    expected = grid(creases=[[0, 1]], crease_sharpness=[2]).positions(V)
    result = reflines.Subdivision(OFFSETS.tolist(), FACES.ravel().astype(np.uint16), vertices=16,
                                  creases=np.array([[0, 1]], np.int64), crease_sharpness=np.array([2], np.float32))
    assert np.array_equal(result.positions(np.asfortranarray(V)), expected)


def test_creases_corners_scheme_and_boundary_arrive() -> None:
    smooth = grid().positions(V)
    assert not np.allclose(grid(creases=[[5, 6]], crease_sharpness=[10.0]).positions(V)[5], smooth[5])
    assert np.allclose(grid(corners=[5], corner_sharpness=[10.0]).positions(V)[5], V[5])
    assert np.allclose(grid(boundary="preserve_corners").positions(V)[0], V[0])
    triangles = np.concatenate([FACES[:, :3], FACES[:, [0, 2, 3]]])
    loop = reflines.Subdivision(np.arange(0, 55, 3), triangles.ravel(), vertices=16, scheme="loop")
    assert loop.faces.shape == (18 * 16, 3)


@pytest.mark.parametrize(("settings", "said"), [
    ({"level": 0}, "level is 0"), ({"level": -1}, "level is -1"), ({"level": 7}, "level is 7"),
    ({"level": 6, "faces": np.tile(FACES, (1100, 1))}, "40 million faces"),
    ({"vertices": 15}, "names vertex 15"), ({"corner": (5, -1)}, "names vertex -1"),
    ({"corner": (1, 0)}, "uses vertex 0 twice"), ({"faces": np.zeros((0, 4), int)}, "no face"),
    ({"faces": FACES[:, :2]}, "fewer than 3 vertices, the first is face 0"),
    ({"offset": (9, 99)}, "to 99"), ({"offset": (2, 99)}, "fewer than 3 vertices, the first is face 2"),
    ({"scheme": "loop"}, "9 faces"),
    ({"creases": [[0, 10]], "crease_sharpness": [1.0]}, "no edge"),
    ({"creases": [[0, 99]], "crease_sharpness": [1.0]}, "no edge"),
    ({"creases": [[0, 1]], "crease_sharpness": [-1.0]}, "-1"),
    ({"creases": [[0, 1]], "crease_sharpness": [np.nan]}, "nan"),
    ({"creases": [[0, 1]], "crease_sharpness": []}, "1 crease"),
    ({"corners": [16], "corner_sharpness": [3.0]}, "names vertex 16"),
    ({"corners": [7], "corner_sharpness": [np.nan]}, "nan"),
])
def test_unusable_input_gets_one_sentence_with_advice(settings: dict, said: str) -> None:
    faces = settings.pop("faces", FACES)
    offsets, corners = np.arange(0, faces.size + 1, faces.shape[1]), faces.ravel().copy()
    for name, array in (("offset", offsets), ("corner", corners)):
        if name in settings:
            place, array[place] = settings.pop(name)
    with pytest.raises(reflines.InvalidInput) as caught:
        reflines.Subdivision(offsets, corners, **{"vertices": 16} | settings)
    assert said in str(caught.value) and ": " in str(caught.value)
    assert str(caught.value).count("\n") == 0


@pytest.mark.parametrize(("settings", "said"), [
    ({"scheme": "bilinear"}, "'bilinear'"), ({"boundary": "none"}, "'none'"),
    ({"creases": [0, 1], "crease_sharpness": [1.0]}, "2 columns"),
])
def test_options_that_are_none_get_one_sentence(settings: dict, said: str) -> None:
    with pytest.raises(reflines.InvalidInput) as caught:
        grid(**settings)
    assert said in str(caught.value)
    assert str(caught.value).count("\n") == 0


def test_an_edge_may_be_infinitely_sharp() -> None:
    assert len(grid(creases=[[0, 1]], crease_sharpness=[np.inf]).faces)


@pytest.mark.parametrize("wrong", [V[:-1], V[:, :2], V.ravel()])
def test_positions_must_fit_the_cage(wrong: np.ndarray) -> None:
    with pytest.raises(reflines.InvalidInput, match="16 rows"):
        grid().positions(wrong)


@pytest.mark.parametrize("scheme", ["catmull_clark", "loop"])
def test_all_levels_lie_on_one_limit_surface_with_one_normal(scheme: str) -> None:
    triangles = np.concatenate([FACES[:, [0, 1, 2]], FACES[:, [0, 2, 3]]])
    faces = triangles if scheme == "loop" else FACES
    offsets = np.arange(0, faces.size + 1, faces.shape[1])
    levels = [reflines.Subdivision(offsets, faces.ravel(), vertices=16, level=level, scheme=scheme)
              for level in range(1, 7)]
    shared = len(levels[0].positions(V))
    for coarse, fine in zip(levels[:-1], levels[1:], strict=True):
        assert len(fine.faces) == 4 * len(coarse.faces)
        assert np.allclose(fine.positions(V)[:shared], levels[0].positions(V), rtol=0, atol=1e-12)
        assert np.allclose(fine.normals(V)[:shared], levels[0].normals(V), rtol=0, atol=1e-10)


def test_an_edge_of_many_faces_is_refused_and_nothing_is_overwritten() -> None:
    pages = [[0, 1, k + 2] for k in range(20)]
    with pytest.raises(ValueError, match="20 faces of the cage share the edge between the vertices 0 and 1"):
        reflines.Subdivision(3 * np.arange(21), np.ravel(pages), vertices=22, level=1)


def test_offsets_whose_differences_overflow_are_refused() -> None:
    offsets = np.array([0, 2147483647, -2147483646, -1000, 4], dtype=np.int32)
    with pytest.raises(ValueError, match="fewer than 3 vertices, the first is face 1"):
        reflines.Subdivision(offsets, [0, 1, 2, 3], vertices=4)
