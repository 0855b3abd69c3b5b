#!/usr/bin/env python3
"""Lets each fault of each series happen, and writes into docs/faults.md what has come of them.

    tests/faults/run.py [BUILD]             all of them, some half an hour on two cores; BUILD: build/
    tests/faults/run.py --check [BUILD]     those of the suite, a few minutes, and writes nothing

The exit code is 1 if a test has failed; then nothing is written either."""
import collections
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
DOCUMENT = ROOT / 'docs/faults.md'
BEGIN, END = '<!-- what run.py has found -->', '<!-- its end -->'
TESTS = {'memory': 'fake', 'disk': 'fake', 'damage': 'fake', 'ends': 'fake', 'jumps': 'fake', 'device': 'kerrd'}


def start(build, name, ledger, whole):
    server = [build / 'src/kerrd', 'serve'] if TESTS[name] == 'kerrd' else [build / 'tests/http/fake_server']
    env = {**os.environ, 'KD_LEDGER': str(ledger), 'PYTHONDONTWRITEBYTECODE': '1', **({'KD_WHOLE': '1'} if whole else {})}
    log = tempfile.TemporaryFile()
    return subprocess.Popen([sys.executable, HERE / f'{name}.py', build / 'tests/faults/libfaults.so', *server], env=env, stdout=log, stderr=log), log


def rows(entries):
    """Markdown: a line a fault and scenario, in the order in which they were tried."""
    found = {}
    for e in entries:
        points, outcomes = found.setdefault((e['kind'], e['scenario']), [0, collections.Counter()])
        found[e['kind'], e['scenario']][0] = points + e['points']
        outcomes.update(e['outcomes'])
    yield '| fault | where | tried | of | what has come of it |'
    yield '|---|---|--:|--:|---|'
    for (kind, scenario), (points, outcomes) in sorted(found.items()):
        told = '; '.join(f'{n} × {word}' for word, n in sorted(outcomes.items(), key=lambda item: -item[1]))
        yield f'| {kind} | {scenario} | {sum(outcomes.values())} | {points} | {told} |'
    yield ''
    totals = collections.Counter()
    for (kind, _), (_, outcomes) in found.items():
        totals[kind] += sum(outcomes.values())
    yield 'In all ' + ', '.join(f'{n} of {kind}' for kind, n in sorted(totals.items())) + f': {sum(totals.values())} faults.'


def main():
    arguments = sys.argv[1:]
    check = '--check' in arguments
    build = pathlib.Path(([a for a in arguments if a != '--check'] or [ROOT / 'build'])[0]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        running = {name: start(build, name, pathlib.Path(folder) / name, not check) for name in TESTS}
        failed = []
        for name, (process, log) in running.items():
            if process.wait():
                failed.append(name)
                log.seek(0)
                sys.stdout.buffer.write(log.read())
        entries = [json.loads(line) for name in TESTS if (pathlib.Path(folder) / name).exists() for line in (pathlib.Path(folder) / name).read_text().splitlines()]
    text = '\n'.join(rows(entries))
    print(text)
    if failed:
        print('failed:', *failed)
    elif not check:
        whole = DOCUMENT.read_text(encoding='utf-8')
        DOCUMENT.write_text(re.sub(f'{BEGIN}.*{END}', lambda _: f'{BEGIN}\n{text}\n\n{END}', whole, flags=re.S), encoding='utf-8')
    return bool(failed)


if __name__ == '__main__':
    sys.exit(main())
