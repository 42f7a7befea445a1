"""What pyproject.toml cannot say of the wheel: the version, data and programs beside the sources, the tag."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # setuptools before 70.1
    from wheel.bdist_wheel import bdist_wheel

ROOT = Path(__file__).resolve().parent
os.environ.setdefault("SOURCE_DATE_EPOCH", "315532800")  # 1980: the same sources give the same wheel, bit for bit


class BuildPackage(build_py):
    """Adds what lies elsewhere in the repository, and the native programs, which are built; an editable one has
    both."""

    def run(self):
        if self.editable_mode:
            return super().run()
        package = Path(self.build_lib).absolute() / "guidewire"
        shutil.rmtree(package, ignore_errors=True)  # what an earlier build left
        super().run()
        subprocess.run([sys.executable, "-m", "tools.package", str(package)], cwd=ROOT, check=True)


class WithPrograms(Distribution):
    """Of one platform."""

    def has_ext_modules(self):
        return True


class BuildWheel(bdist_wheel):
    """For any Python 3, and Linux with the newest glibc that one of the programs needs by its symbol table."""

    def get_tag(self):
        build = Path(self.get_finalized_command("build_py").build_lib)
        programs = [str(path) for path in build.glob("guidewire/native/*")]
        if not programs:
            return "py3", "none", "any"  # an editable one
        symbols = subprocess.run(["readelf", "-V", *programs], capture_output=True, text=True, check=True).stdout
        newest = max(map(int, re.findall(r"GLIBC_2\.(\d+)", symbols)))
        return "py3", "none", f"manylinux_2_{newest}_{os.uname().machine}"


setup(version=re.search(r'Number = "([^"]+)"', (ROOT / "Assets/Guidewire/Core/ProgramVersion.cs").read_text())[1],
      distclass=WithPrograms, cmdclass={"build_py": BuildPackage, "bdist_wheel": BuildWheel})
