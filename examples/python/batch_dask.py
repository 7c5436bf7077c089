# SPDX-License-Identifier: Apache-2.0
"""Refocuses many inputs on the workers of a Dask cluster: batch_dask.py [--scheduler ADDRESS] FOLDER INPUT... [-- OPTION...]

Each input (a photo or a light-field folder) is one task, which runs `starfocus refocus INPUT -o FOLDER/NAME.jpg OPTION...`.
All workers need the program `starfocus` and the same file system. Without --scheduler, the workers are processes of this
machine.

A second run with the same arguments computes only the pictures that are missing. A task whose worker is killed is
computed again by another worker. The exit code is 0 if all pictures exist, and otherwise 1.
"""
import argparse
import subprocess
import sys
from pathlib import Path

from distributed import Client, LocalCluster, as_completed

# Largest number of times that the program is started for one input, if it is killed each time. The setting
# distributed.scheduler.allowed-failures limits the number of workers that are killed.
ATTEMPTS = 3


def refocus(source: str, picture: str, options: list[str]) -> str:
    """Refocuses one input on a worker. Returns an empty string, or the message of the program."""
    command = ["starfocus", "refocus", source, "-o", picture, *options]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode < 0:  # the program was killed, for example because the memory was full
        raise ChildProcessError(f"starfocus was ended by signal {-result.returncode}")
    if result.returncode == 0:
        return ""
    return result.stderr.strip() or f"exit code {result.returncode}"


def name_pictures(sources: list[str], folder: Path) -> dict[str, str]:
    """Returns the input of each picture. Raises ValueError if two inputs would write the same picture."""
    pictures: dict[str, str] = {}
    for source in sources:
        name = Path(source).resolve().name if Path(source).is_dir() else Path(source).stem
        picture = str(folder / f"{name}.jpg")
        if picture in pictures:
            raise ValueError(f"{picture}: expected one input, found {pictures[picture]} and {source}")
        pictures[picture] = source
    return pictures


def run(client: Client, pictures: dict[str, str], options: list[str]) -> dict[str, str]:
    """Refocuses all inputs whose pictures do not exist yet. Returns the problem of each input that failed.

    `pictures` contains the input of each picture, and the folder of the pictures exists.
    """
    # The program writes a picture under its final name only when it is complete.
    missing = {picture: source for picture, source in pictures.items() if not Path(picture).exists()}
    print(f"{len(pictures) - len(missing)} of {len(pictures)} pictures exist.", flush=True)
    tasks = {
        client.submit(refocus, source, picture, options, key=picture, pure=False, retries=ATTEMPTS - 1): source
        for picture, source in missing.items()
    }
    problems = {}
    for count, task in enumerate(as_completed(tasks), 1):
        error = task.exception()
        problem = f"{error or task.result()}"
        if problem:
            problems[tasks[task]] = problem
        print(f"{count} of {len(tasks)}: {tasks[task]}: {problem or 'written'}", flush=True)
    return problems


def main() -> int:
    """Reads the arguments, and refocuses on the cluster. Returns the exit code, or exits with an error message."""
    arguments = sys.argv[1:]
    at = arguments.index("--") if "--" in arguments else len(arguments)
    parser = argparse.ArgumentParser(description=__doc__.split(":")[0])
    parser.add_argument("--scheduler", help="address of a Dask scheduler, such as tcp://node1:8786")
    parser.add_argument("folder", type=Path, help="folder of the pictures")
    parser.add_argument("input", nargs="+", help="photos and light-field folders")
    given = parser.parse_args(arguments[:at])
    sources = [str(Path(source).absolute()) for source in given.input]
    try:
        pictures = name_pictures(sources, given.folder.absolute())
        given.folder.mkdir(parents=True, exist_ok=True)
        client = Client(given.scheduler or LocalCluster(threads_per_worker=1, dashboard_address=None))
    except (OSError, ValueError) as error:
        sys.exit(f"batch_dask.py: {error}")
    with client:
        problems = run(client, pictures, arguments[at + 1:])
    for source, problem in problems.items():
        print(f"{source}: {problem}", file=sys.stderr)
    print(f"{len(sources) - len(problems)} of {len(sources)} pictures exist, {len(problems)} inputs failed.")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
