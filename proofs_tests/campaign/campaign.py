#!/usr/bin/env python3
"""Runs `blum medial` on families of generated models and records every run (README.md here).

    campaign.py run    --tool BLUM --store RUNS.db --count 1000 [--workers 2] [--families a,b]
    campaign.py run    --tool BLUM --store RUNS.db --files FOLDER... [--count 1000]
    campaign.py table  --store RUNS.db [--commit ID]
    campaign.py list   --store RUNS.db [--outcome undecided]
    campaign.py replay --tool BLUM --store RUNS.db ID
    campaign.py model  --store RUNS.db ID -o MODEL.off
    campaign.py shrink --tool BLUM --store RUNS.db ID -o FIXTURE.off [--seconds 600]

Python's standard library alone. Exit codes: 0 no defect, 1 usage, 3 a wrong answer, a crash or a run
that did not end, 130 interrupted (what was finished is recorded; the same command goes on).
"""

import argparse
import concurrent.futures
import json
import pathlib
import signal
import subprocess
import sys
import time

import families
import files
import table
from families import FAMILIES
from mesh import Mesh, betti_numbers
from runner import CERTIFIED, Limits, OUTCOMES, Runner, is_defect
from shrink import Shrinker
from store import Store, model_text

DEFECT_FOUND, INTERRUPTED = 3, 130


def commit_of(tool):
    """Of the checkout that the tool was built in, "-changed" if it has uncommitted changes."""
    def git(*arguments):
        ended = subprocess.run(["git", *arguments], cwd=pathlib.Path(tool).resolve().parent,
                               capture_output=True, encoding="utf-8")
        return ended.stdout.strip() if ended.returncode == 0 else None

    commit = git("rev-parse", "--short=12", "HEAD")
    if commit is None:
        return "unknown"
    return commit + ("-changed" if git("status", "--porcelain", "--untracked-files=no") else "")


def generate(family, seed):
    """A family that is not of families.py is a file."""
    return (families if family in FAMILIES else files).generate(family, seed)


def names_of(arguments):
    if arguments.files:
        names, others = files.found(arguments.files)
        for other in others:
            print(f"{other}: no mesh of faces", file=sys.stderr)
        return names or sys.exit("no mesh files: " + ", ".join(arguments.files))
    names = arguments.families.split(",") if arguments.families else list(FAMILIES)
    unknown = [name for name in names if name not in FAMILIES]
    return sys.exit("no such family: " + ", ".join(unknown)) if unknown else names


def plan(arguments, store, done):
    """(index, (family, seed)) of the runs that are missing, of every family in turn; or of those that
    once ended otherwise than certified."""
    names = names_of(arguments)
    if arguments.again:
        rows = store.runs("outcome = ? AND limits != ?", (arguments.again, limits_of(arguments).text()))
        every = not arguments.families and not arguments.files
        jobs = sorted({(row["family"], row["seed"]) for row in rows if every or row["family"] in names})
    else:
        jobs = [(names[i % len(names)], arguments.first_seed + i // len(names))
                for i in range(arguments.count or len(names))]
    return ((i, job) for i, job in enumerate(jobs) if job not in done)


def one_run(runner, index, job, axis_every, verify_every):
    name, seed = job
    mesh, parameters, expected = generate(name, seed)
    row = runner.run(mesh, expected, parameters["blum_seed"],
                     axis_every > 0 and index % axis_every == 0 and len(mesh.faces) <= 400,
                     verify_every > 0 and index % verify_every == 0)
    if row is None:
        return None
    row.update(family=name, seed=seed, parameters=parameters)
    return row, mesh


def run(arguments):
    commit = arguments.commit or commit_of(arguments.tool)
    limits = limits_of(arguments)
    store, runner = Store(arguments.store), Runner(arguments.tool, limits)
    stop_on_signals()
    jobs = plan(arguments, store, store.done(commit, limits.text()))
    defects, start, finished = 0, time.monotonic(), 0
    pool = concurrent.futures.ThreadPoolExecutor(arguments.workers)
    pending = set()

    def submit():
        late = arguments.seconds and time.monotonic() - start > arguments.seconds
        job = None if late else next(jobs, None)
        if job is not None:
            pending.add(pool.submit(one_run, runner, *job, arguments.check_axis,
                                    arguments.verify))

    try:
        for _ in range(arguments.workers):
            submit()
        while pending:
            ready, _ = concurrent.futures.wait(
                pending, return_when=concurrent.futures.FIRST_COMPLETED)
            for future in ready:
                pending.discard(future)
                row, mesh = future.result()
                row.update(commit_id=commit, limits=limits.text())
                notable = row["outcome"] != CERTIFIED or is_defect(row)
                identifier = store.add(row, mesh if notable else None)
                finished += 1
                defects += is_defect(row)
                if notable or arguments.verbose:
                    print(f"{identifier}: {row['family']} {row['seed']}: {ending_text(row)} "
                          f"({row['faces']} faces, {row['time_s']:.1f} s)", flush=True)
                submit()
    except KeyboardInterrupt:
        runner.stop()
        print(f"interrupted after {finished} runs", file=sys.stderr)
        return INTERRUPTED
    finally:
        runner.stop()
        pool.shutdown(cancel_futures=True)
        store.close()
    print(f"{finished} runs in {time.monotonic() - start:.0f} s, {defects} defects")
    return DEFECT_FOUND if defects else 0


def ending(row):
    """What a run has to have in common with another that ends as it does."""
    said = (row["certificate"], row["statement"]) if is_defect(row) and row["certificate"] else None
    return row["outcome"], row["reason"], said


def ending_text(row):
    text = f"{row['outcome']} {row['reason']}".strip()
    return text + (f", certificate {row['certificate']}: {row['statement']}"
                   if is_defect(row) and row["certificate"] else "")


def run_again(runner, mesh, row, arguments):
    """With the checks that the recorded run had, and those asked for."""
    return runner.run(mesh, betti_numbers(mesh), json.loads(row["parameters"])["blum_seed"],
                      arguments.check_axis > 0 or row["axis_checked"] is not None,
                      arguments.verify > 0 or row["certificate_s"] is not None)


def stop_on_signals():
    def raise_interrupt(*_):
        raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, raise_interrupt)
    signal.signal(signal.SIGINT, raise_interrupt)


def selected(arguments):
    condition, values = [], []
    for name, value in (("commit_id", arguments.commit), ("outcome", arguments.outcome)):
        if value:
            condition.append(f"{name} = ?")
            values.append(value)
    return Store(arguments.store).runs(" AND ".join(condition) or "1", values)


def print_table(arguments):
    print((table.certificates if arguments.certificates else table.text)(selected(arguments)))


def print_list(arguments):
    for row in selected(arguments):
        print(f"{row['id']}: {row['family']} {row['seed']}: {ending_text(row)}; "
              f"{row['faces']} faces, {row['sites']} sites, {row['time_s']:.1f} s, "
              f"{row['undecided_cells']} cells undecided; {row['parameters']}")


def recorded(arguments):
    """The row and the model of the run, which has to be the one that was run."""
    row = Store(arguments.store).run(arguments.id)
    if row is None:
        sys.exit("no such run")
    text = model_text(row)
    mesh = Mesh.from_off(text) if text else generate(row["family"], row["seed"])[0]
    if Runner.hash_of(mesh) != row["model_hash"]:
        sys.exit("the generator has changed since: this model is another one")
    return row, mesh


def replay(arguments):
    row, mesh = recorded(arguments)
    runner = Runner(arguments.tool, limits_of(arguments))
    new = run_again(runner, mesh, row, arguments)
    before = {name: row[name] for name in row.keys() if name not in ("model", "id")}
    for name, value in new.items():
        print(f"{name:15} {value}" + ("" if name not in before or encoded(value) == before[name]
                                      else f"    was {before[name]}"))
    return DEFECT_FOUND if is_defect(new) else 0


def encoded(value):
    return json.dumps(value) if isinstance(value, list) else value


def write_model(arguments):
    pathlib.Path(arguments.output).write_text(recorded(arguments)[1].off())


def shrink(arguments):
    row, mesh = recorded(arguments)
    runner = Runner(arguments.tool, limits_of(arguments))
    seed = json.loads(row["parameters"])["blum_seed"]
    end = time.monotonic() + arguments.seconds
    tries = 0

    def fails(candidate):
        nonlocal tries
        tries += 1
        return ending(run_again(runner, candidate, row, arguments)) == ending(row)

    if not fails(mesh):
        sys.exit(f"does not end as '{ending_text(row)}' any more (with these limits)")
    small = Shrinker(fails, lambda: time.monotonic() < end).shrink(mesh)
    pathlib.Path(arguments.output).write_text(small.off())
    print(f"{ending_text(row)}: {len(mesh.faces)} faces, now {len(small.faces)}; {tries} tries; "
          f"--seed {seed}")


def limits_of(arguments):
    return Limits(arguments.time_limit, arguments.max_memory, arguments.max_cells,
                  arguments.grace)


def parser():
    top = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    commands = top.add_subparsers(required=True)

    def command(name, function, runs):
        p = commands.add_parser(name)
        p.set_defaults(function=function)
        p.add_argument("--store", required=True, help="the SQLite file")
        if runs:
            p.add_argument("--tool", required=True, help="the built blum")
            p.add_argument("--time-limit", type=float, default=60.0, help="seconds of a run")
            p.add_argument("--max-memory", type=int, default=4096, help="MiB of a run; 0: no limit")
            p.add_argument("--max-cells", type=int, default=0, help="0: the tool's default")
            p.add_argument("--grace", type=float, default=30.0,
                           help="seconds after the limit (and a quarter) when a run is killed")
            p.add_argument("--check-axis", type=int, default=0,
                           help="check radii by brute force in every nth run")
            p.add_argument("--verify", type=int, default=0,
                           help="write and verify a certificate in every nth run")
        return p

    p = command("run", run, True)
    what = p.add_mutually_exclusive_group()
    what.add_argument("--count", type=int, default=0,
                      help="runs of this commit and these limits that the store shall hold (default: "
                           "one of each family or file)")
    what.add_argument("--again", choices=OUTCOMES,
                      help="the models that ended so with other limits")
    p.add_argument("--workers", type=int, default=1)
    models = p.add_mutually_exclusive_group()
    models.add_argument("--families", help="some of " + ",".join(FAMILIES))
    models.add_argument("--files", nargs="+", metavar="FOLDER",
                        help="OFF, OBJ and STL files instead of families; from seed 2 on in another guise")
    p.add_argument("--first-seed", type=int, default=1)
    p.add_argument("--seconds", type=float, default=0, help="start no run after so long")
    p.add_argument("--commit", help="what to record (default: git's HEAD where the tool stands)")
    p.add_argument("--verbose", action="store_true", help="a line for certified runs too")
    for name, function in (("table", print_table), ("list", print_list)):
        p = command(name, function, False)
        p.add_argument("--commit")
        p.add_argument("--outcome", choices=OUTCOMES)
        if function is print_table:
            p.add_argument("--certificates", action="store_true", help="a line a verified run")
    for name, function, runs in (("replay", replay, True), ("model", write_model, False),
                                 ("shrink", shrink, True)):
        p = command(name, function, runs)
        p.add_argument("id", type=int)
        if function is not replay:
            p.add_argument("-o", "--output", required=True)
    p.add_argument("--seconds", type=float, default=600)
    return top


if __name__ == "__main__":
    chosen = parser().parse_args()
    sys.exit(chosen.function(chosen) or 0)
