"""A cluster whose checks of parameters are interrupted while they wait, as by Ctrl-C; argument: the folder to work
in."""

import json
import os
import signal
import sys
import threading
import time
from pathlib import Path

from guidewire.runs.runner import Request
from guidewire.sweeps.cluster import Cluster
from guidewire.sweeps.worker import Job


def answer_slowly():
    """A runner that is asked for checks alone; the second one after a while."""
    for line in sys.stdin:
        name = json.loads(line)["id"]
        time.sleep(0.0 if name == "version" else 0.4)
        print(json.dumps({"id": name, "exitCode": 0, "message": "", "address": "0" * 32, "version": "1"}), flush=True)


def main(folder):
    signal.signal(signal.SIGINT, signal.default_int_handler)
    with Cluster([sys.executable, __file__], folder, None, None, 2) as cluster:
        jobs = [Job(Request(f"run {k}", None, None), False, 10.0) for k in range(6)]
        threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
        cluster.check(jobs)


if __name__ == "__main__":
    if "-lines" in sys.argv:
        answer_slowly()
    else:
        try:
            main(Path(sys.argv[1]))
        except KeyboardInterrupt:
            print("interrupted")
