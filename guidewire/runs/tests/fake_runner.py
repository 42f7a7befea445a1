"""A stand-in for the headless runner's lines mode: it simulates nothing and misbehaves as the request asks.

`set` of a request steers it: {"die": code} ends the process before the answer, {"signal": number} kills it,
{"babble": text} answers something that is no JSON, {"sleep": seconds} works for that long, {"until": file} works until
that file is there, a minute at most, {"exitCode": code}
fails in the ordinary way, {"lost": 1} leaves a summary that says that the log was lost; {"refused": text} is refused
where it is checked. {"once": 1} lets all that happen the first time only. Everything it was asked stands in the file
named by its first argument, one line each: process id, start and end of the run, request.
"""

import hashlib
import json
import os
import signal
import sys
import time
from pathlib import Path


class Interrupted(Exception):
    pass


def interrupt(_signal, _frame):
    raise Interrupted


def check(request, answer):
    """The answer to a request that is only checked."""
    wish = {key: value for key, value in request["set"].items() if key not in ("logSpheres", "logOrientations")}
    if "refused" in wish:
        return {**answer, "exitCode": 2, "outcome": None, "message": wish["refused"]}
    version = os.environ.get("FAKE_VERSION", "fake 1")
    address = hashlib.sha256(json.dumps([version, wish], sort_keys=True).encode()).hexdigest()[:32]
    return {**answer, "address": address, "version": version}


def main(journal):
    signal.signal(signal.SIGINT, interrupt)
    for line in sys.stdin:
        started = time.monotonic()
        request = json.loads(line)
        wish = request["set"]
        answer = {"id": request["id"], "exitCode": 0, "outcome": "converged", "message": "done"}
        if request.get("check"):
            print(json.dumps(check(request, answer)), flush=True)
            continue
        out = Path(request["out"])
        if "once" in wish and (out / "begun").exists():
            wish = {}
        out.mkdir(parents=True, exist_ok=True)
        try:
            (out / "begun").touch()
            if "die" in wish:
                os._exit(wish["die"])
            if "signal" in wish:
                os.kill(os.getpid(), wish["signal"])
            time.sleep(wish.get("sleep", 0))
            while "until" in wish and not Path(wish["until"]).exists() and time.monotonic() < started + 60.0:
                time.sleep(0.02)
            if "exitCode" in wish:
                answer.update(exitCode=wish["exitCode"], outcome=None, message="guidewire: bad key")
            else:
                log = "positions.json" if request.get("log", True) else None
                if log and "lost" in wish:
                    log, answer = "positions.json.partial", {**answer, "outcome": "failed", "message": "disk is full"}
                if log:
                    (out / log).write_text("{}")
                (out / "summary.json").write_text(json.dumps(
                    {"outcome": answer["outcome"], "reason": "done", "steps": len(wish), "computationTime": 0.001,
                     "log": log,
                     "complete": True}))
        except Interrupted:
            answer.update(exitCode=130, outcome="interrupted", message="interrupted")
        with open(journal, "a") as file:
            file.write(json.dumps([os.getpid(), started, time.monotonic(), request]) + "\n")
        print(wish.get("babble") or json.dumps(answer), flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
