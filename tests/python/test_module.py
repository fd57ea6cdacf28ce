"""The stubs name what the module has, and every example of a docstring holds."""

import ast
import doctest
import inspect
from pathlib import Path

import pytest

import reprise

public = {name: getattr(reprise, name) for name in reprise.__all__ if not inspect.ismodule(getattr(reprise, name))}


def members(one):
    return {name for name in vars(one) if not name.startswith("_")}


def test_the_stubs_name_what_the_module_has():
    tree = ast.parse((Path(reprise.__file__).parent / "__init__.pyi").read_text())
    stubs = {node.name: node for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
    classes = {"OptimizeResult"}  # SciPy's or our own
    assert set(stubs) - classes == set(public)
    for name, node in stubs.items():
        if name in classes or not isinstance(node, ast.ClassDef):
            continue
        named = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
        if not issubclass(public[name], Exception):
            assert {one for one in named if not one.startswith("_")} == members(public[name]), name
    assert (Path(reprise.__file__).parent / "py.typed").exists()


@pytest.mark.parametrize("name", sorted(public))
def test_examples_of_docstrings_hold(name):
    assert public[name].__doc__
    for example in doctest.DocTestFinder(recurse=False).find(public[name], name, module=False, globs={}):
        result = doctest.DocTestRunner(verbose=False).run(example)
        assert result.failed == 0
