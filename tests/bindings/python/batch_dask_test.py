# SPDX-License-Identifier: Apache-2.0
"""Tests examples/python/batch_dask.py on a local cluster: batch_dask_test.py PROGRAM LIGHT-FIELD FOLDER."""
import os
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from unittest import mock

import dask
from distributed import Client, LocalCluster

sys.path.insert(0, str(Path(__file__).parents[3] / "examples/python"))
import batch_dask

INPUTS = 8
OPTIONS = ["--mode", "benchmark"]  # takes long enough that a worker can be killed while it computes


def kill_worker(pids: list[int], folder: Path) -> None:
    """Kills a worker as soon as the first picture exists."""
    while not any(folder.glob("*.jpg")):
        time.sleep(0.01)
    os.kill(pids[0], signal.SIGKILL)


def error_of(arguments: list[str]) -> str:
    """Returns the error message with which the script exits."""
    try:
        with mock.patch.object(sys, "argv", ["batch_dask.py", *arguments]):
            return str(batch_dask.main())
    except SystemExit as error:
        return str(error.code)


def main() -> None:
    """Runs the test, and raises AssertionError if it fails."""
    program, light_field, work = Path(sys.argv[1]), Path(sys.argv[2]).absolute(), Path(sys.argv[3]).absolute()
    os.environ["PATH"] = f"{program.absolute().parent}:{os.environ['PATH']}"
    sources = [work / f"input{k}" for k in range(INPUTS)]
    work.mkdir()
    for source in sources:
        source.mkdir()
        for file in light_field.iterdir():
            (source / file.name).symlink_to(file)
    bad = work / "bad.jpg"
    bad.write_text("no picture")
    folder, expected = work / "out", work / "expected.jpg"
    folder.mkdir()
    subprocess.run([program, "refocus", sources[0], "-o", expected, *OPTIONS], check=True)
    names = [str(path) for path in [*sources, bad]]
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        pids = list(client.run(os.getpid).values())
        killer = threading.Thread(target=kill_worker, args=(pids, folder), daemon=True)
        killer.start()
        problems = batch_dask.run(client, batch_dask.name_pictures(names, folder), OPTIONS)
        killer.join(60)
        assert not killer.is_alive(), "no picture was written"
        assert pids[0] not in client.run(os.getpid).values(), "the worker was not killed"
        assert list(problems) == [str(bad)], problems
        assert "bad.jpg" in problems[str(bad)], problems
        pictures = sorted(folder.iterdir())
        assert [path.name for path in pictures] == [f"{source.name}.jpg" for source in sources], pictures
        assert all(path.read_bytes() == expected.read_bytes() for path in pictures), "other bytes"
        # A second run writes only the missing picture.
        times = {path: path.stat().st_mtime_ns for path in pictures[1:]}
        pictures[0].unlink()
        assert batch_dask.run(client, batch_dask.name_pictures(names[:-1], folder), OPTIONS) == {}
        assert pictures[0].read_bytes() == expected.read_bytes()
        assert times == {path: path.stat().st_mtime_ns for path in pictures[1:]}, "pictures were written again"
    with dask.config.set({"distributed.comm.timeouts.connect": "1s"}):
        for arguments, message in (
                ([str(folder), "a/x.jpg", "b/x.png"], "x.jpg: expected one input, found .*/a/x.jpg and .*/b/x.png$"),
                ([str(bad), "x.jpg"], "File exists: .*bad.jpg"),
                (["--scheduler", "tcp://127.0.0.1:1", str(folder), "x.jpg"], "Timed out .* tcp://127.0.0.1:1"),
                (["--scheduler", "node1", str(folder), "x.jpg"], "missing port number in address 'node1'")):
            found = error_of(arguments)
            assert re.search("^batch_dask.py: .*" + message, found), found
    print(f"{INPUTS} inputs, one worker killed")


if __name__ == "__main__":
    main()
