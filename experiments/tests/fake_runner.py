"""A stand-in for the headless runner's lines mode: it simulates nothing and misbehaves as the request asks.

`set` of a request steers it: {"die": code} ends the process before the answer, {"signal": number} kills it,
{"dieLater": 1} ends it after the answer,
{"babble": text} answers something that is no JSON, {"sleep": seconds} works for that long, {"exitCode": code}
fails in the ordinary way. Everything it was asked stands in the file named by its first argument, one line each:
process id, start and end of the run, request.
"""

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


def main(journal):
    signal.signal(signal.SIGINT, interrupt)
    for line in sys.stdin:
        started = time.monotonic()
        request = json.loads(line)
        wish = request["set"]
        answer = {"id": request["id"], "exitCode": 0, "outcome": "converged", "message": "done",
                  "out": request["out"], "reused": False}
        try:
            if "die" in wish:
                os._exit(wish["die"])
            if "signal" in wish:
                os.kill(os.getpid(), wish["signal"])
            time.sleep(wish.get("sleep", 0))
            if "exitCode" in wish:
                answer.update(exitCode=wish["exitCode"], outcome=None, message="guidewire: bad key")
            elif (Path(request["out"]) / "summary.json").exists():
                answer["reused"] = True
            else:
                Path(request["out"]).mkdir(parents=True)
                (Path(request["out"]) / "summary.json").write_text("{}")
        except Interrupted:
            answer.update(exitCode=130, outcome="interrupted", message="interrupted")
        with open(journal, "a") as file:
            file.write(json.dumps([os.getpid(), started, time.monotonic(), request]) + "\n")
        print(wish.get("babble") or json.dumps(answer), flush=True)
        if "dieLater" in wish:
            os._exit(1)


if __name__ == "__main__":
    main(sys.argv[1])
