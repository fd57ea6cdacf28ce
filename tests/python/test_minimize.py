"""minimize(): SciPy's interface on standard problems, results as in C++, callbacks that throw, and interruptions."""

import copy
import pickle
import signal
import subprocess
import sys
import threading
import time
import traceback

import numpy as np
import pytest

import reprise

optimize = pytest.importorskip("scipy.optimize")

names = """hs1 hs3 hs4 hs6 hs7 hs10 hs11 hs12 hs14 hs21 hs22 hs24 hs27 hs28 hs29 hs35 hs43 hs48 hs65 hs71 hs76 hs78
hs100 beale""".split()


def as_scipy(one):
    """A standard problem as SciPy takes it."""
    p = one.problem
    constraints = []
    if p.inequalities:
        constraints.append(
            {"type": "ineq", "fun": lambda x: -p.inequality(x), "jac": lambda x: -p.inequality_jacobian(x)}
        )
    if p.equalities:
        constraints.append({"type": "eq", "fun": p.equality, "jac": p.equality_jacobian})
    lower = p.lower if p.lower.size else np.full(p.n, -np.inf)
    upper = p.upper if p.upper.size else np.full(p.n, np.inf)
    bounds = list(zip(lower, upper))
    return dict(fun=p.objective, x0=one.start, jac=p.gradient, bounds=bounds, constraints=constraints)


@pytest.mark.parametrize("name", names)
def test_scipys_interface_gives_what_cpp_gives(name):
    one = reprise.standard_problem(name)
    native = one.problem.solve(one.start, "slsqp")
    given = as_scipy(one)
    ours = reprise.minimize(**given, method="slsqp")
    assert isinstance(ours, optimize.OptimizeResult)
    assert ours.x.tolist() == native["x"].tolist() and ours.fun == native["fun"] and ours.nfev == native["nfev"]
    # The optimum of the source, by SciPy's own call.
    other = optimize.minimize(**given, method=reprise.minimize, options={"check_stationarity": False})
    assert other.maxcv < 1e-5
    if name == "hs1":  # Rosenbrock's valley, in which Dynamic-Q does not come far
        assert other.status_name == "iteration_limit" and not other.success
    else:
        assert other.fun == pytest.approx(one.f_optimum, rel=1e-3, abs=1e-3)


@pytest.mark.parametrize("method", reprise.solver_names())
def test_every_solver_finds_the_optimum_of_a_small_problem(method):
    options = {"seed": 1, "max_points": 50_000} if method == "isres" else {}
    result = reprise.minimize(
        lambda x: (x[0] - 2) ** 2 + (x[1] - 1) ** 2,
        [0.0, 0.0],
        method=method,
        bounds=[(-5, 5), (-5, 5)],
        constraints={"type": "ineq", "fun": lambda x: 2 - x[0] - x[1]},
        options=options,
    )
    assert result.x == pytest.approx([1.5, 0.5], abs=1e-2 if method == "isres" else 1e-4)
    assert result.fun == pytest.approx(0.5, abs=1e-2 if method == "isres" else 1e-4)


def test_scipys_constraint_objects_and_bounds():
    def fun(x):
        return (x[0] - 2) ** 2 + (x[1] - 1) ** 2, np.array([2 * (x[0] - 2), 2 * (x[1] - 1)])

    linear = optimize.LinearConstraint([[1, 1]], -np.inf, 2)
    curved = optimize.NonlinearConstraint(lambda x: x[0] + x[1], 0.5, 2, jac=lambda x: [[1, 1]])
    equal = optimize.NonlinearConstraint(lambda x: x[0] - x[1], 1, 1)
    for constraints in (linear, [curved], [linear, equal]):
        result = reprise.minimize(fun, [0, 0], jac=True, bounds=optimize.Bounds([-5, -5], [5, 5]), constraints=constraints)
        assert result.x == pytest.approx([1.5, 0.5], abs=1e-4)


def test_callbacks_see_every_iterate_and_may_stop():
    seen = []
    result = reprise.minimize(lambda x: x @ x, [1.0, 2.0], callback=lambda x: seen.append(x.copy()))
    assert len(seen) == result.nit and seen[0].tolist() == [1.0, 2.0]

    def enough(x):
        raise StopIteration

    for callback in (enough, lambda x: True):
        result = reprise.minimize(lambda x: x @ x, [1.0, 2.0], callback=callback)
        assert result.status_name == "stopped" and not result.success


class Unlucky(Exception):
    pass


@pytest.mark.parametrize("method", reprise.solver_names())
@pytest.mark.parametrize("where", ["fun", "jac", "constraint", "callback"])
def test_exceptions_travel_with_their_traceback(method, where):
    calls = [0]

    def thrower(value):
        def function(x):
            calls[0] += 1
            if calls[0] > 3:
                raise Unlucky(where)
            return value(x)

        return function

    given = dict(
        fun=lambda x: (x[0] - 1) ** 2 + 10 * (x[1] - x[0] ** 2) ** 2,
        jac=None,
        constraint=lambda x: 2 - x[0] - x[1],
        callback=lambda x: None,
    )
    if where == "jac":
        if method in ("cobyla", "isres"):
            pytest.skip("it takes no derivatives")
        given["jac"] = lambda x: np.array([2 * (x[0] - 1) - 40 * x[0] * (x[1] - x[0] ** 2), 20 * (x[1] - x[0] ** 2)])
    given[where] = thrower(given[where])
    with pytest.raises(Unlucky) as caught:
        reprise.minimize(
            given["fun"],
            [-1.2, 1.0],
            method=method,
            jac=given["jac"],
            bounds=[(-2, 2)] * 2,
            constraints={"type": "ineq", "fun": given["constraint"]},
            callback=given["callback"],
        )
    assert any(frame.name == "function" for frame in traceback.extract_tb(caught.value.__traceback__))


@pytest.mark.parametrize(
    "change, message",
    [
        (dict(x0=[[1, 2]]), "shape"),
        (dict(x0=[1, np.nan]), "start|x0|finite"),
        (dict(method="simplex"), "simplex"),
        (dict(jac="cs"), "jac"),
        (dict(jac=lambda x: [1.0]), r"\(2,\)"),
        (dict(bounds=[(0, 1)]), "bounds has 1 pairs"),
        (dict(bounds=[(1, 0), (0, 1)]), "bound"),
        (dict(options={"speed": 1}), "speed"),
        (dict(constraints={"type": "less", "fun": lambda x: x[0]}), "less"),
        (dict(constraints={"type": "ineq", "fun": lambda x: x[0], "jac": lambda x: [1.0]}), r"\(1, 2\)|rows|index"),
        (dict(method="mma", constraints={"type": "eq", "fun": lambda x: x[0]}), "equalit"),
    ],
)
def test_wrong_input_is_refused(change, message):
    with pytest.raises(ValueError, match=message):
        reprise.minimize(**{**dict(fun=lambda x: x @ x, x0=[1.0, 2.0]), **change})


def test_wrong_types_are_refused():
    with pytest.raises(TypeError):
        reprise.minimize(lambda x: None, [1.0])
    with pytest.raises(ValueError):
        reprise.minimize(lambda x: "small", [1.0])
    with pytest.raises(ValueError):
        reprise.minimize(lambda x: x @ x, ["one"])


def test_a_function_that_is_not_a_number_is_a_status():
    result = reprise.minimize(lambda x: np.nan, [1.0, 2.0])
    assert not result.success and result.status_name == "numerical_failure"


def test_runs_in_threads_do_not_disturb_each_other():
    one = reprise.standard_problem("hs71")
    expected = one.problem.solve(one.start)["x"].tolist()
    found = [None] * 4

    def work(k):
        given = as_scipy(one)
        found[k] = reprise.minimize(**given).x.tolist()

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [expected] * 4


def test_results_and_standard_problems_are_copied():
    result = reprise.minimize(lambda x: x @ x, [1.0])
    for twin in (copy.deepcopy(result), pickle.loads(pickle.dumps(result))):
        assert twin.fun == result.fun and twin.x.tolist() == result.x.tolist()
    one = reprise.standard_problem("hs43")
    assert pickle.loads(pickle.dumps(one)).f_optimum == one.f_optimum


def test_ctrl_c_stops_a_run():
    code = (
        "import reprise\n"
        "print('begun', flush=True)\n"
        "while True: reprise.minimize(lambda x: x @ x, [1.0], method='isres', bounds=[(-1, 1)], "
        "options={'max_points': 10**9})\n"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", code],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # What runs in the background of a shell ignores Ctrl-C, and so would this process.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    process.stdout.readline()
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)
    error = process.communicate(timeout=60)[1]
    assert process.returncode != 0 and "KeyboardInterrupt" in error


def test_scipy_is_not_needed():
    code = (
        "import sys; sys.modules['scipy'] = None; sys.modules['scipy.optimize'] = None\n"
        "import reprise; r = reprise.minimize(lambda x: x @ x, [1.0]); print(type(r).__module__, r.success)"
    )
    answer = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert answer.split() == ["reprise.minimize", "True"]
