"""minimize(), with the signature and the result of scipy.optimize.minimize; SciPy itself is not needed."""

import numpy as np

from ._core import Problem

try:
    from scipy.optimize import OptimizeResult
except ImportError:

    class OptimizeResult(dict):
        """A dictionary whose keys are attributes too, as SciPy's has them."""

        def __getattr__(self, name):
            try:
                return self[name]
            except KeyError as error:
                raise AttributeError(name) from error

        __setattr__ = dict.__setitem__
        __delattr__ = dict.__delitem__


_differences = {None: "automatic", False: "automatic", "2-point": "forward", "3-point": "central"}


class _Together:
    """A function that returns value and gradient, called once for each point."""

    def __init__(self, function):
        self.function = function
        self.x = None

    def _at(self, x):
        if self.x is None or not np.array_equal(x, self.x):
            self.answer = self.function(x)
            self.x = np.array(x)
        return self.answer

    def value(self, x):
        return self._at(x)[0]

    def gradient(self, x):
        return self._at(x)[1]


def _bounds(bounds, n):
    """Lower and upper bounds of SciPy's Bounds, or of pairs in which None means none."""
    if bounds is None:
        return np.empty(0), np.empty(0)
    if hasattr(bounds, "lb"):
        lower, upper = bounds.lb, bounds.ub
    else:
        pairs = list(bounds)
        if len(pairs) != n:
            raise ValueError(f"bounds has {len(pairs)} pairs, but it must have {n}, one for each variable.")
        lower = [-np.inf if low is None else low for low, _ in pairs]
        upper = [np.inf if high is None else high for _, high in pairs]
    return tuple(np.broadcast_to(np.asarray(end, float), (n,)).copy() for end in (lower, upper))


class _Rows:
    """Constraints of one kind, one below the other, each as sign * (its values[rows] - offset)."""

    def __init__(self, n):
        self.n = n
        self.parts = []
        self.count = 0
        self.exact = True

    def add(self, function, jacobian, rows, sign, offset):
        self.parts.append((function, jacobian, rows, sign, offset))
        self.count += len(rows)
        self.exact = self.exact and jacobian is not None

    def values(self, x):
        return np.concatenate(
            [
                sign * (np.atleast_1d(np.asarray(function(x), float))[rows] - offset)
                for function, _, rows, sign, offset in self.parts
            ]
        )

    def jacobian(self, x):
        blocks = []
        for _, jacobian, rows, sign, _ in self.parts:
            block = jacobian(x)
            block = np.atleast_2d(block.toarray() if hasattr(block, "toarray") else np.asarray(block, float))
            blocks.append(sign * block[rows])
        return np.vstack(blocks)


def _add_dictionary(one, x0, inequalities, equalities):
    kind = str(one.get("type")).lower()
    if kind not in ("ineq", "eq"):
        raise ValueError(f"the type of a constraint is {one.get('type')!r}, but it must be 'ineq' or 'eq'.")
    args = one.get("args", ())
    function, jacobian = one["fun"], one.get("jac")

    def values(x):
        return function(x, *args)

    derivatives = (lambda x: jacobian(x, *args)) if callable(jacobian) else None
    size = np.atleast_1d(np.asarray(values(x0), float)).size
    rows, sign = (equalities, 1.0) if kind == "eq" else (inequalities, -1.0)
    rows.add(values, derivatives, np.arange(size), sign, 0.0)


def _add_object(one, x0, inequalities, equalities):
    """SciPy's LinearConstraint or NonlinearConstraint: lb <= values <= ub."""
    if hasattr(one, "A"):
        matrix = np.atleast_2d(one.A.toarray() if hasattr(one.A, "toarray") else np.asarray(one.A, float))

        def values(x):
            return matrix @ x

        def derivatives(x):
            return matrix

    else:
        values = one.fun
        derivatives = one.jac if callable(one.jac) else None
    size = np.atleast_1d(np.asarray(values(x0), float)).size
    lower, upper = (np.broadcast_to(np.asarray(end, float), (size,)) for end in (one.lb, one.ub))
    equal = np.flatnonzero(lower == upper)
    below = np.flatnonzero((lower != upper) & np.isfinite(upper))
    above = np.flatnonzero((lower != upper) & np.isfinite(lower))
    if equal.size:
        equalities.add(values, derivatives, equal, 1.0, lower[equal])
    if below.size:
        inequalities.add(values, derivatives, below, 1.0, upper[below])
    if above.size:
        inequalities.add(values, derivatives, above, -1.0, lower[above])


def minimize(
    fun,
    x0,
    args=(),
    method="dynamic_q",
    jac=None,
    hess=None,
    hessp=None,
    bounds=None,
    constraints=(),
    tol=None,
    callback=None,
    options=None,
    **further_options,
):
    """Minimise fun(x, *args) from x0, an array (n,), as scipy.optimize.minimize does.

    method: one of solver_names(). jac: the gradient, array (n,); True where fun returns (value, gradient); "2-point",
    "3-point" or None for differences. hess and hessp are not used. bounds: pairs, or SciPy's Bounds. constraints:
    dictionaries with "type" ("ineq" means not negative, or "eq"), "fun", and perhaps "jac" and "args", or SciPy's
    LinearConstraint and NonlinearConstraint. tol: the step tolerance of Dynamic-Q. options: a dictionary, see Problem.solve.
    callback(x) is called at every iterate; where it returns True or raises StopIteration, the run ends.

    Returns SciPy's OptimizeResult, or a dictionary like it where there is no SciPy: x, fun, success, status and
    status_name, message, nfev, njev, nit, maxcv (the largest violation) and kkt_residual.

    It is a method for SciPy as well: scipy.optimize.minimize(..., method=reprise.minimize).

    >>> import reprise
    >>> result = reprise.minimize(lambda x: (x[0] - 1) ** 2 + x[1] ** 2, [3.0, 2.0], bounds=[(0, None), (0.5, None)])
    >>> result.success, result.x.round(4).tolist()
    (True, [1.0, 0.5])
    """
    start = np.atleast_1d(np.asarray(x0, float))
    if start.ndim != 1:
        raise ValueError(f"x0 has the shape {start.shape}, but it must be (n,).")
    n = start.size
    if not isinstance(args, tuple):
        args = (args,)
    settings = {**(options or {}), **further_options}
    if tol is not None:
        settings.setdefault("step_tolerance", tol)

    def objective(x):
        return fun(x, *args)

    gradient = None
    if jac is True:
        together = _Together(objective)
        objective, gradient = together.value, together.gradient
    elif callable(jac):

        def gradient(x):
            return jac(x, *args)

    elif jac in _differences:
        settings.setdefault("derivatives", _differences[jac])
    else:
        raise ValueError(f"jac is {jac!r}, but it must be a function, True, None, '2-point' or '3-point'.")

    lower, upper = _bounds(bounds, n)
    inequalities, equalities = _Rows(n), _Rows(n)
    if isinstance(constraints, dict) or hasattr(constraints, "lb"):
        constraints = (constraints,)
    for one in constraints:
        (_add_dictionary if isinstance(one, dict) else _add_object)(one, start, inequalities, equalities)

    def functions(rows):
        if rows.count == 0:
            return 0, None, None
        return rows.count, rows.values, rows.jacobian if rows.exact else None

    problem = Problem(n, objective, gradient, lower, upper, *functions(inequalities), *functions(equalities))

    def observe(x):
        try:
            return bool(callback(x))
        except StopIteration:
            return True

    return OptimizeResult(problem.solve(start, method, settings, observe if callback is not None else None))
