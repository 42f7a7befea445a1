"""The examples of the docs are true to the types of what they import."""

import json
import os
import re
import shutil
import subprocess
import sys

import pytest

from guidewire.prepare import ROOT, PreparationError
from guidewire.viewer import parts
from tools.testing import FULL_CAMPAIGNS

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


@pytest.mark.skipif(FULL_CAMPAIGNS not in os.environ, reason="half a minute: in 'test --all'")
def test_the_examples_of_each_page_have_the_right_types(tmp_path):
    node = shutil.which("node")
    if node is None:
        pytest.skip("no node: as root 'apt-get install nodejs npm'")
    try:
        checker = parts.require("devDependencies", print) / "pyright" / "index.js"
    except PreparationError as error:
        pytest.skip(str(error))
    examples = {page.stem: re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
                for page in PAGES}
    assert sum(map(len, examples.values())) > 10
    for name, blocks in examples.items():
        (tmp_path / f"{name}.py").write_text("\n\n".join(blocks))
    (tmp_path / "wrong.py").write_text("from guidewire import Session\nSession(None).step(push='far')\n")
    (tmp_path / "pyrightconfig.json").write_text(json.dumps({"extraPaths": [str(ROOT)], "typeCheckingMode": "basic"}))
    done = subprocess.run([node, str(checker), "--pythonpath", sys.executable, "--outputjson"], cwd=tmp_path,
                          capture_output=True, text=True, timeout=600, check=False)
    errors = [f"{one['file']}:{one['range']['start']['line'] + 1}: {one['message']}"
              for one in json.loads(done.stdout)["generalDiagnostics"] if one["severity"] == "error"
              and not re.match(r'Import "(gymnasium|stable_baselines3)\b', one["message"])]    # readers install them
    assert len(errors) == 1 and "wrong.py:2" in errors[0], errors
