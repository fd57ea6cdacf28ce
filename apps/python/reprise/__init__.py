"""Workspaces and dimensional synthesis of planar parallel manipulators, and Dynamic-Q with nine other optimizers.

Lengths are in the unit of the manipulator, angles in radians. Wrong input raises ValueError with name, value and what is
allowed; numerical outcomes are statuses.
"""

from ._core import (
    InputError,
    Manipulator,
    Problem,
    Region,
    StandardProblem,
    SynthesisProblem,
    assembly_modes,
    check_certificate,
    collinear,
    constant_orientation_workspace,
    dextrous_workspace,
    enclose_minimum,
    kappa_inverse,
    kappa_inverse_of_designs,
    orientation_workspace,
    pose,
    prove_design,
    prove_global_optimum,
    read_problem,
    solver_names,
    standard_problem,
    standard_problems,
    synthesis_solver_names,
    synthesize,
    trace,
    write_certificate,
)
from .minimize import minimize

__all__ = [name for name in dir() if not name.startswith("_")]
