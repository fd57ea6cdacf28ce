"""What the tests share. PYTHONPATH holds build/python, where the module is."""

import json
import subprocess
from pathlib import Path

import pytest

import reprise

top = Path(__file__).resolve().parents[2]
examples = top / "examples"
program = top / "build" / "bin" / "reprise"


def run_program(*arguments):
    """The document that the program reprise prints."""
    command = [str(program), *map(str, arguments), "--json"]
    return json.loads(subprocess.run(command, capture_output=True, check=True, text=True).stdout)


@pytest.fixture
def m1():
    return reprise.Manipulator.from_file(examples / "M1.toml")
