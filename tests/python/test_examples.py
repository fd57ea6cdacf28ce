"""The example scripts run without a screen and make their pictures."""

import subprocess
import sys

import pytest
from conftest import top

pytest.importorskip("matplotlib")
pytest.importorskip("scipy")


@pytest.mark.parametrize("name", ["figure_5_8", "own_problem", "atlas"])
def test_examples_make_their_pictures(name, tmp_path):
    picture = tmp_path / f"{name}.png"
    script = top / "apps" / "python" / "examples" / f"{name}.py"
    subprocess.run([sys.executable, str(script), str(picture)], check=True, cwd=tmp_path)
    assert picture.read_bytes().startswith(b"\x89PNG")
