"""Chooses the Python for a command: the first with the packages that it imports, or a new virtual environment.

The order: the running one; .venv in the repository; Debian's /usr/bin/python3; a new .venv filled by pip from
requirements.txt; on Debian as root, apt's packages with /usr/bin/python3. Standard library only, and readable by
Python 3.6, because it is the oldest Python that must still be able to find a newer one.
"""

import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import traceback
from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent
INSTALLED = (_PACKAGE / "native").is_dir()  # the installed package holds its programs; in the repository they are built
ROOT = _PACKAGE if INSTALLED else _PACKAGE.parent  # of params, instruments and docs
DOOR = "guidewire" if INSTALLED else "python3 guidewire.py"  # what people type
MINIMUM_VERSION = (3, 9)
VENV = ROOT / ".venv"
SYSTEM_PYTHON = Path("/usr/bin/python3")
LOG = ROOT / "results" / "prepare.log"

DRAWING = ("numpy", "scipy", "matplotlib")
SWEEPING = ("distributed", "tqdm", "scipy")
VIEWING = ("aiohttp",)
ANATOMY = DRAWING + ("vtkmodules",)
DICOM = ("pydicom",)
TESTING = DRAWING + SWEEPING + VIEWING + ("pytest", "xdist", "hypothesis")

EXTRAS = {  # of the installed package: what only some commands import
    "draw": ("scipy", "matplotlib"), "sweep": ("dask", "distributed", "tqdm"), "view": ("aiohttp",),
    "anatomy": ("vtkmodules",), "dicom": ("pydicom",), "gym": ("gymnasium",),
}

PACKAGING = ("pip", "setuptools", "wheel")

_DEBIAN_NAMES = {"vtkmodules": "vtk9", "xdist": "pytest-xdist"}  # what an import is called elsewhere
_PIP_NAMES = {"vtkmodules": "vtk", "xdist": "pytest-xdist"}
_MORE = (*PACKAGING, "vtkmodules", "pydicom")  # what only some commands need, and so is not in requirements.txt

_HANDED_OVER = "GUIDEWIRE_HANDED_OVER"
_PIP_SECONDS = 900
_CHECK = (
    "import importlib.util, sys; "
    "sys.exit(sys.version_info < {} or any(importlib.util.find_spec(n) is None for n in sys.argv[1:]))"
).format(MINIMUM_VERSION)


class PreparationError(Exception):
    """No Python can run the command; the text is one line that says what to install."""


def require_version():
    """Return if the running Python is new enough, else hand over to one that is (this call then never returns)."""
    if sys.version_info >= MINIMUM_VERSION:
        return
    for candidate in _candidates() + [shutil.which("python3.%d" % minor) for minor in range(14, 8, -1)]:
        if candidate and has_packages(candidate, ()):
            _hand_over(candidate)
    raise PreparationError(
        "Python {}.{} or newer is needed, this is {}.{}: install one and start guidewire.py with it".format(
            MINIMUM_VERSION[0], MINIMUM_VERSION[1], sys.version_info[0], sys.version_info[1]
        )
    )


def require_packages(packages):
    """Return if the running Python has all packages (import names), else hand over to one that has, making it if
    there is none. Raises PreparationError where none can be made."""
    packages = tuple(dict.fromkeys(packages))  # two groups may have one in common
    missing = [name for name in packages if importlib.util.find_spec(name) is None]
    if not missing:
        return
    if INSTALLED:  # a package does not install others
        extras = [extra for extra, names in EXTRAS.items() if set(missing) & set(names)]
        raise PreparationError("this needs the Python packages {}: 'pip install \"guidewire{}\"' installs them".format(
            ", ".join(missing), "[{}]".format(",".join(extras)) if extras else ""))
    for candidate in _candidates():
        if has_packages(candidate, packages):
            _hand_over(candidate)
    for make in (_fill_venv, _install_with_apt):
        made = make(packages)
        if made is not None and has_packages(made, packages):
            _hand_over(made)
    names = " ".join("python3-" + _DEBIAN_NAMES.get(name, name) for name in packages)
    raise PreparationError(
        "Python packages {} are missing and could not be installed (log: {}): as root 'apt-get install {}', or with "
        "a network 'python3 -m venv .venv && .venv/bin/pip install -r requirements.txt'; then try again".format(
            ", ".join(packages), os.path.relpath(str(LOG)), names
        )
    )


def has_packages(python, packages):
    """True if the interpreter starts, is new enough and finds every package."""
    try:
        # A folder that holds no package of that name, so that the answer does not depend on where we stand.
        check = subprocess.run(
            [str(python), "-c", _CHECK] + list(packages),
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=str(_PACKAGE),
        )
    except OSError:
        return False
    return check.returncode == 0


def _candidates():
    return [path for path in (_venv_python(), SYSTEM_PYTHON) if path.exists()]


def _venv_python():
    return VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def _fill_venv(packages):
    """Return a .venv with requirements.txt in it, or None. A .venv that was made here and could not be filled is
    removed."""
    existed = VENV.exists()
    _say("installing {} into .venv with pip".format(", ".join(packages)))
    made = existed or _log_run([sys.executable, "-m", "venv", str(VENV)], seconds=120)
    # Two tries of ten seconds: without a network pip must give up soon, not after its default of minutes.
    pip = [str(_venv_python()), "-m", "pip", "install", "--retries", "1", "--timeout", "10", "--prefer-binary"]
    more = [_PIP_NAMES.get(name, name) for name in packages if name in _MORE]
    if made and _log_run(pip + ["-r", str(ROOT / "requirements.txt")] + more, seconds=_PIP_SECONDS):
        return _venv_python()
    if not existed:
        shutil.rmtree(str(VENV), ignore_errors=True)
    return None


def _install_with_apt(packages):
    """Debian's packages for /usr/bin/python3, or None where this is not Debian or not root."""
    apt = shutil.which("apt-get")
    if apt is None or os.name == "nt" or os.geteuid() != 0:
        return None
    _say("pip could not; installing {} with apt".format(", ".join(packages)))
    names = ["python3-" + _DEBIAN_NAMES.get(name, name) for name in packages]
    options = ["-q", "-y", "-o", "DPkg::Lock::Timeout=120"]
    install = [apt] + options + ["install", "--no-install-recommends"] + names
    _log_run([apt] + options + ["update"], seconds=300)
    # Without a limit: apt that is killed while it unpacks leaves Debian's packages broken.
    return SYSTEM_PYTHON if _log_run(install, seconds=None) else None


def _log_run(command, seconds):
    """Run quietly, output appended to LOG. True if it ended with 0 in time."""
    LOG.parent.mkdir(parents=True, exist_ok=True)
    environment = dict(os.environ, DEBIAN_FRONTEND="noninteractive")
    with LOG.open("ab") as log:
        log.write("$ {}\n".format(" ".join(command)).encode())
        log.flush()
        try:
            return subprocess.run(
                command, stdin=subprocess.DEVNULL, stdout=log, stderr=log, env=environment, timeout=seconds
            ).returncode == 0
        except (OSError, subprocess.TimeoutExpired) as error:
            log.write("{}\n".format(error).encode())
            return False


def _say(line):
    print("guidewire: {} (log: {})".format(line, os.path.relpath(str(LOG))), file=sys.stderr, flush=True)


def _hand_over(python):
    """Replace this process by the same command line in another Python; a second time would be a loop."""
    if os.environ.get(_HANDED_OVER) == str(python):
        raise PreparationError("{} was chosen twice and still cannot run the command".format(python))
    os.environ[_HANDED_OVER] = str(python)
    command = [str(python)] + sys.argv
    if os.name == "nt":  # there execv returns to the shell before the new process has ended
        sys.exit(subprocess.run(command).returncode)
    os.execv(str(python), command)


def report(error, secret=""):
    """Put the trace of the error that is handled now into a file, and say where in one line.

    Parameters
    ----------
    secret : what neither is to show.
    """
    trace = Path(tempfile.mkdtemp(prefix="guidewire-")) / "error.txt"
    line = f"guidewire: internal error ({type(error).__name__}: {error}): please report {trace}"
    hidden = [text.replace(secret, "...") if secret else text for text in (traceback.format_exc(), line)]
    trace.write_text(hidden[0], encoding="utf-8")
    print(hidden[1], file=sys.stderr, flush=True)
