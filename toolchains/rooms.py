#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# rooms.py: prints one row for each room (folder) of lib, and for simd: how many files and named types share the code,
# and how large files and functions are. CONTRIBUTING.md has the rules behind these columns. Requires Universal Ctags.
# Fails only if a file of the project has more than 600 lines of code; public headers may be longer.
import collections
import os
import pathlib
import re
import statistics
import subprocess
import sys

LONGEST_FILE, LONG_FUNCTION = 600, 60
HEAD = ('room', 'files', 'lines', 'median', 'p75', 'types', 'lines/type', 'params p95', f'over {LONG_FUNCTION} lines',
        'one user')

Function = collections.namedtuple('Function', 'path parameters lines')


def sources(*folders):
    return [path for folder in folders for path in sorted(pathlib.Path(folder).rglob('*'))
            if path.suffix in ('.h', '.hpp', '.c', '.cc') or path.name == 'CMakeLists.txt']


def is_public(path):
    return path.is_relative_to('lib/include')


def code_lines(path):
    """Returns the number of lines that contain more than a comment."""
    text = path.read_text()
    if path.name == 'CMakeLists.txt':
        text = re.sub('#.*', '', text)
    else:
        text = re.sub(r'/\*.*?\*/', lambda comment: '\n' * comment[0].count('\n'), text, flags=re.S)
        text = re.sub('//.*', '', text)
    return sum(1 for line in text.splitlines() if line.strip())


def count_parameters(signature):
    """Returns the number of parameters in a signature such as `(int32_t a, const std::array<int, 2>& b) const`."""
    nested = re.compile(r'<[^<>]*>|(?<=.)\([^()]*\)')
    while nested.search(signature):
        signature = nested.sub('', signature)
    inside = signature[1:].partition(')')[0].strip()
    return 0 if inside in ('', 'void') else inside.count(',') + 1


def read_tags(files):
    """Returns the path of each named structure, class and enumeration, and a Function for each function."""
    command = 'ctags --languages=C,C++ --langmap=C++:+.h --kinds-C++=scgf --fields=kSne -f - -L -'.split()
    names = '\n'.join(map(str, files))
    output = subprocess.run(command, input=names, text=True, stdout=subprocess.PIPE, check=True).stdout
    types, functions = [], []
    for line in output.splitlines():
        name, path, *_ = line.split('\t')
        kind, *fields = line.partition(';"\t')[2].split('\t')
        fields = dict(field.split(':', 1) for field in fields)
        if kind == 'f':
            functions.append(Function(pathlib.Path(path), count_parameters(fields.get('signature', '()')),
                                      int(fields.get('end', fields['line'])) - int(fields['line']) + 1))
        elif kind in 'scg' and not name.startswith('__anon'):
            types.append(pathlib.Path(path))
    return types, functions


def count_users(files):
    """Returns the number of files that include each header, except the source of the same name."""
    users = collections.Counter()
    for path in files:
        included = set(re.findall(r'^#include "([^"]+)"', path.read_text(), flags=re.M))
        users.update(included - {str(path.with_suffix('.h'))})
    return users


def percentile(values, share):
    return sorted(values)[int(share * (len(values) - 1))] if values else 0


def row(name, lines, types, functions, users):
    """Returns the columns of HEAD for the files whose numbers of code lines are `lines`."""
    counts, total = list(lines.values()), sum(lines.values())
    own_types = sum(1 for path in types if path in lines and not is_public(path))
    own_functions = [function for function in functions if function.path in lines]
    headers = [path for path in lines
               if path.suffix == '.h' and not is_public(path) and not path.name.endswith('-inl.h')]
    return (name, len(lines), total, round(statistics.median(counts)), percentile(counts, 0.75),
            own_types, total // own_types if own_types else '',
            percentile([function.parameters for function in own_functions], 0.95),
            sum(1 for function in own_functions if function.lines > LONG_FUNCTION),
            sum(1 for header in headers if users[str(header)] < 2))


def main():
    os.chdir(pathlib.Path(__file__).resolve().parent.parent)
    lines = {path: code_lines(path) for path in sources('lib', 'simd', 'platform', 'examples', 'tests')}
    engine = {path: count for path, count in lines.items() if path.parts[0] in ('lib', 'simd')}
    found = (*read_tags([path for path in engine if path.suffix != '.txt']), count_users(lines))
    rooms = sorted({str(path.parent) for path in engine if len(path.parts) == 3} | {'lib/include'}) + ['lib', 'simd']
    rows = [HEAD]
    rows += [row(room, {path: engine[path] for path in engine if path.is_relative_to(room)}, *found) for room in rooms]
    rows.append(row('lib + simd', engine, *found))
    for first, *cells in rows:
        print(f'{first:<13}', *(f'{cell:>{max(6, len(head))}}' for cell, head in zip(cells, HEAD[1:])), sep='  ')
    _, files, total, _, _, _, per_type, *_ = rows[-1]
    print(f'lines per type: {per_type} (aim: at least 85); lines per file: {total // files} (aim: at least 110)')
    too_long = [path for path in lines if lines[path] > LONGEST_FILE and not is_public(path)]
    for path in too_long:
        print(f'{path}: {lines[path]} lines of code (expected at most {LONGEST_FILE})', file=sys.stderr)
    return len(too_long) > 0


sys.exit(main())
