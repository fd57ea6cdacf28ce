"""The README's lines run."""

import re

from conftest import top


def test_the_lines_of_the_readme_run(monkeypatch, capsys):
    monkeypatch.chdir(top)
    lines = re.search(r"```python\n(.*?)```", (top / "README.md").read_text(encoding="utf-8"), re.DOTALL)[1]
    exec(lines, {})
    assert len(capsys.readouterr().out.splitlines()) == 3
