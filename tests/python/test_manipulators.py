"""Manipulators, poses, workspaces: against the program reprise, to the last bit, and against closed forms."""

import copy
import math
import pickle
import threading

import numpy as np
import pytest
from conftest import examples, run_program

import reprise

ring = reprise.Manipulator([[0, 0]], [[0, 0]], [[1, 2]])


def test_pose_is_that_of_the_program(m1):
    document = run_program("pose", examples / "M1.toml", "--at", 1, 1.5)
    found = reprise.pose(m1, [1, 1.5])
    assert found["legs"] == document["legs"]
    assert found["jacobian"] == document["jacobian"]
    assert found["kappa_inv"] == document["kappa_inv"]
    assert reprise.kappa_inverse(m1, 1, 1.5) == document["kappa_inv"]


def test_modes_are_those_of_the_program(m1):
    document = run_program("assemble", examples / "M1.toml", "--lengths", 1.8, 1.8, 1.5)
    modes = reprise.assembly_modes(m1, [1.8, 1.8, 1.5])
    assert modes["poses"][:, :2].tolist() == [[mode["x"], mode["y"]] for mode in document["modes"]]
    assert modes["multiplicities"] == [mode["multiplicity"] for mode in document["modes"]]


def test_workspaces_are_those_of_the_program(m1):
    region = reprise.constant_orientation_workspace(m1)
    assert region.area == run_program("workspace", examples / "M1.toml")["area"]
    lower, upper = -5 * (math.pi / 180), 5 * (math.pi / 180)
    m2 = reprise.Manipulator.from_file(examples / "M2.toml")
    document = run_program("dextrous", examples / "M2.toml", "--range", -5, 5)
    assert reprise.dextrous_workspace(m2, lower, upper).area == document["area"]
    traced = run_program("workspace", examples / "M1.toml", "--chord", 0.02)
    walked = reprise.trace(m1)
    assert walked["area"] == traced["area"]
    assert walked["boundary"][0][0].tolist() == traced["components"][0]["boundary"]


def test_orientations_are_those_of_the_program():
    m2 = reprise.Manipulator.from_file(examples / "M2.toml")
    document = run_program("orientation", examples / "M2.toml", "--at", 1, 1.5)
    found = reprise.orientation_workspace(m2, [1, 1.5]) / (math.pi / 180)
    assert found.tolist() == document["intervals_deg"]


def test_a_ring_has_its_area_its_hole_and_its_points():
    region = reprise.constant_orientation_workspace(ring)
    assert region.area == pytest.approx(3 * math.pi, abs=1e-12)
    assert region.perimeter == pytest.approx(6 * math.pi, abs=1e-12)
    assert (len(region), region.holes) == (1, 1)
    x, y = np.meshgrid(np.linspace(-2.5, 2.5, 37), np.linspace(-2.5, 2.5, 41), indexing="ij")
    distance = np.hypot(x, y)
    off = np.minimum(abs(distance - 1), abs(distance - 2)) > 1e-12  # on the boundary it may be either
    assert off.sum() > 1500 and (region.contains(x, y) == ((distance > 1) & (distance < 2)))[off].all()
    outer, hole = region.boundary(0.01)[0]
    assert np.hypot(*outer.T) == pytest.approx(2) and np.hypot(*hole.T) == pytest.approx(1)
    polygon = region.geojson(0.1)["coordinates"][0]
    assert len(polygon) == 2 and all(loop[0] == loop[-1] for loop in polygon)


def test_many_poses_are_the_poses_one_by_one_whatever_the_strides(m1):
    random = np.random.default_rng(1)
    x, y, phi = random.uniform(-1, 2, (3, 40, 30))
    one_by_one = [reprise.kappa_inverse(m1, *pose) for pose in zip(x.flat, y.flat, phi.flat)]
    assert reprise.kappa_inverse(m1, x, y, phi).ravel().tolist() == one_by_one
    for turn in (np.transpose, np.flipud, lambda a: a[::3, 1::2], lambda a: np.asfortranarray(a)):
        expected = turn(np.reshape(one_by_one, x.shape))
        assert (reprise.kappa_inverse(m1, turn(x), turn(y), turn(phi)) == expected).all()
    row = reprise.kappa_inverse(m1, x[:, :1], y[0], 0.1)
    assert row.shape == (40, 30) and row[3, 4] == reprise.kappa_inverse(m1, x[3, 0], y[0, 4], 0.1)
    assert reprise.kappa_inverse(m1, [], []).shape == (0,)
    assert np.isnan(reprise.kappa_inverse(m1, [np.nan, 0.1], [1.0, 1.0])).tolist() == [True, False]


def test_many_designs_are_the_designs_one_by_one():
    random = np.random.default_rng(2)
    designs = random.uniform(0.1, 2, (7, 5))
    found = reprise.kappa_inverse_of_designs(designs, 0.3, 1.2, 0.1)
    single = [reprise.kappa_inverse(reprise.collinear(d, [[0, 1]] * 3), 0.3, 1.2, 0.1) for d in designs]
    assert found.tolist() == single


@pytest.mark.parametrize(
    "arguments",
    [
        ([[0, 0]], [[0, 0]], [[2, 1]]),
        ([[0, 0]], [[0, 0]], [[-1, 1]]),
        ([[0, math.nan]], [[0, 0]], [[1, 2]]),
        ([[0, 0]], [[0, 0], [1, 1]], [[1, 2]]),
        ([0, 0], [[0, 0]], [[1, 2]]),
        (np.zeros((0, 2)), np.zeros((0, 2)), np.zeros((0, 2))),
    ],
)
def test_what_is_no_manipulator_is_refused(arguments):
    with pytest.raises(ValueError, match="must be|no leg|at least"):
        reprise.Manipulator(*arguments)


def test_wrong_input_is_refused(m1, tmp_path):
    with pytest.raises(TypeError):
        reprise.Manipulator("joints", [[0, 0]], [[1, 2]])
    with pytest.raises(TypeError):
        reprise.pose("M1", [0, 0])
    with pytest.raises(ValueError, match="orientation"):
        reprise.constant_orientation_workspace(m1, math.nan)
    with pytest.raises(ValueError, match="shape mismatch"):
        reprise.kappa_inverse(m1, [1, 2], [1, 2, 3])
    with pytest.raises(ValueError, match="spacing"):
        reprise.constant_orientation_workspace(ring).boundary(0)
    with pytest.raises(ValueError, match="chord"):
        reprise.trace(m1, chord=-1)
    with pytest.raises(ValueError, match="3"):
        reprise.kappa_inverse_of_designs([1, 2, 3], 0, 0)
    with pytest.raises(reprise.InputError, match="none.toml"):
        reprise.Manipulator.from_file(tmp_path / "none.toml")


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))])
def test_copies_and_pickles_are_the_same(copied, m1):
    wedge = reprise.Manipulator(
        [[0, 0]], [[1, 0]], [[1, 2]], base_angles=[(0.1, 1.5)], platform_angles=[None], normalisation="printed", unit="mm"
    )
    for manipulator in (m1, wedge):
        other = copied(manipulator)
        assert other.to_toml() == manipulator.to_toml() and other.unit == manipulator.unit
        region = reprise.constant_orientation_workspace(manipulator)
        twin = copied(region)
        assert twin.area == region.area and twin.holes == region.holes
        assert [e.tolist() for e in twin.edges[0]] == [e.tolist() for e in region.edges[0]]


def test_threads_get_what_one_gets(m1):
    x, y = np.meshgrid(np.linspace(0, 2, 100), np.linspace(0, 2, 100))
    expected = reprise.kappa_inverse(m1, x, y)
    found = [None] * 4

    def work(k):
        for _ in range(5):
            found[k] = reprise.kappa_inverse(m1, x, y)
            reprise.constant_orientation_workspace(m1, 0.01 * k)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all((one == expected).all() for one in found)
