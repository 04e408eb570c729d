#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the program as a user does: exit statuses, messages, files, restart.

Usage: program.py --program FILE --scenes DIR --directory DIR GROUP
Each function test_GROUP_... is one test; all of a group are run, and the exit
status is 0 where all pass.
"""
import argparse
import csv
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree

SUCCESS, BAD_INPUT, FAILURE, STOPPED = range(4)
arguments = None


class Failed(Exception):
    pass


def expect(condition, *what):
    if not condition:
        raise Failed(' '.join(str(w) for w in what))


def scene(name):
    """A regression scene of this directory."""
    return os.path.join(os.path.dirname(os.path.abspath(__file__)),
                        name + '.prm')


def directory(name):
    """An empty directory for the files of one run."""
    path = os.path.join(arguments.directory, name)
    shutil.rmtree(path, ignore_errors=True)
    return path


def command(*options, **entries):
    line = [arguments.program, *options]
    for entry, value in entries.items():
        line += ['--set', f'{entry}={value}']
    return line


def run(status, *options, **entries):
    """Run the program, expect the status, and return its output."""
    done = subprocess.run(command(*options, **entries), text=True,
                          timeout=200, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)
    expect(done.returncode == status, 'status', done.returncode, 'instead of',
           status, '\n', done.stdout)
    return done.stdout


def history(path, name='history'):
    with open(os.path.join(path, name + '.csv'), encoding='utf-8') as file:
        return [{k: float(v) for k, v in row.items()}
                for row in csv.DictReader(file)]


def summary(path):
    with open(os.path.join(path, 'run.json'), encoding='utf-8') as file:
        return json.load(file)


def jack(path, status=SUCCESS, *options, **entries):
    return run(status, scene('jack'), '--output-directory', path, *options,
               **entries)


# ---------------------------------------------------------------- usage

def test_usage_help_and_version():
    text = run(SUCCESS, '--help')
    for option in ('--set', '--output-directory', '--print-parameters',
                   '--validate', '--restart', '--version', '--help'):
        expect(option in text, option, 'is not in --help')
    expect(re.match(r'caisson_mpm \d', run(SUCCESS, '--version')), 'version')
    expect('No parameter file' in run(BAD_INPUT), 'no file')
    text = run(BAD_INPUT, '--outptu-directory', 'x')
    expect('--output-directory' in text, 'nearest option:', text)


def test_usage_parameters_can_be_read_again():
    os.makedirs(arguments.directory, exist_ok=True)
    path = os.path.join(arguments.directory, 'all.prm')
    with open(path, 'w', encoding='utf-8') as file:
        file.write(run(SUCCESS, scene('jack'), '--print-parameters'))
    expect('is valid' in run(SUCCESS, path, '--validate'), 'validate')
    again = run(SUCCESS, path, '--print-parameters')
    with open(path, encoding='utf-8') as file:
        expect(file.read() == again, 'printed parameters change')
    expect(re.search(r'Units: ', again), 'units')


def test_usage_every_user_scene_is_valid():
    for folder, _, names in os.walk(arguments.scenes):
        for name in sorted(names):
            if name.endswith('.prm'):
                run(SUCCESS, os.path.join(folder, name), '--validate')


def test_usage_set_overrides():
    text = run(SUCCESS, scene('jack'), '--print-parameters',
               **{'Soil/Layer 1/Friction angle': 33})
    expect(re.search(r'set Friction angle\s*= 33', text), 'override')


def test_usage_output_files():
    path = directory('files')
    jack(path, **{'Time/End penetration': 0.53,
                  'Output/Record interval': 0.1,
                  'Output/Frame penetrations': 0.51})
    with open(os.path.join(path, 'history.csv'), encoding='utf-8') as file:
        expect(file.readline().startswith(
            'time_s,penetration_m,tip_force_N,inner_friction_N,'
            'outer_friction_N,total_force_N,'), 'header of history.csv')
    rows = history(path)
    expect(rows[0]['penetration_m'] == 0.5, 'first record')
    expect(abs(rows[-1]['penetration_m'] - 0.53) < 1e-9, 'last record')
    for row in rows:
        parts = sum(row[k] for k in ('tip_force_N', 'inner_friction_N',
                                     'outer_friction_N', 'top_force_N'))
        expect(abs(parts - row['total_force_N']) < 1e-3, 'sum of forces')
    about = summary(path)
    for key in ('version', 'dealii_version', 'ranks', 'material_points',
                'cells', 'steps', 'wall_time_s', 'point_steps_per_second',
                'peak_memory_bytes', 'limiter_count', 'points_lost',
                'sections'):
        expect(key in about, key, 'is not in run.json')
    expect(about['points_lost'] == 0 and about['max_points_in_body'] == 0,
           'points lost or in the body')
    expect(about['steps'] == rows[-1]['step'], 'steps')
    for name in ('points.pvd', 'grid.pvd'):
        root = xml.etree.ElementTree.parse(os.path.join(path, name)).getroot()
        frames = [(float(d.get('timestep')), d.get('file'))
                  for d in root.iter('DataSet')]
        times = sorted({t for t, _ in frames})
        expect(len(times) == 3 and times[0] == 0., name, 'frames at', times)
        expect(abs(times[-1] - rows[-1]['time_s']) < 1e-6, name, 'last frame')
        for _, file in frames:
            data = os.path.join(path, file)
            expect(os.path.getsize(data) > 1000, file)
            with open(data, 'rb') as raw:
                expect(b'<VTKFile' in raw.read(500), file, 'is no VTK file')


def test_usage_verification():
    path = directory('verification')
    entries = {'Output/Terminal': 'full', 'Time/End time': 0.02,
               'Verification/Checks':
               'max displacement_r : 0 : 1e-9; mean velocity_z : 1 : 0.1'}
    text = run(FAILURE, scene('wave_xpic'), '--output-directory', path,
               **entries)
    expect('within 1e-09: yes' in text and 'within 0.1: no' in text, text)
    with open(os.path.join(path, 'verification.json'), encoding='utf-8') as f:
        checks = json.load(f)
    expect([c['pass'] for c in checks] == [True, False], checks)
    for key in ('quantity', 'computed', 'exact', 'relative_error', 'tolerance'):
        expect(key in checks[0], key)


def test_usage_observations():
    """Of every step; and each kind of check can fail."""
    path = directory('observations')
    run(SUCCESS, scene('wave_series'), '--output-directory', path)
    rows = history(path, 'observations')
    expect(list(rows[0]) == ['time_s', 'top', 'mode', 'half', 'side'],
           list(rows[0]))
    expect(len(rows) == summary(path)['steps'] + 1 == len(history(path)),
           len(rows), 'rows')
    expect(min(row['top'] for row in rows) < 1.9 * rows[-1]['half'] * 1.31e-5,
           'the wave')
    with open(os.path.join(path, 'verification.json'), encoding='utf-8') as f:
        n_checks = len(json.load(f))
    failing = ('frequency mode : 1 : 0.01', 'amplitude mode : 0.5 : 0.1',
               'final half : 5 : 0.1', 'trace top : 0 : 1e-6',
               'average top : 0 : 1e-6', 'below half : -6', 'above half : -4',
               'between half : -4 : -3', 'drift top : 0.1',
               'spread stress_zz : 0.1', 'rms displacement_z : 1 : 0.5')
    text = run(FAILURE, scene('wave_series'), '--output-directory', path,
               **{'Verification/Checks': ';'.join(failing)})
    expect(text.count(': no\n') == len(failing) > n_checks, text)
    text = run(FAILURE, scene('wave_series'), '--output-directory', path,
               **{'Verification/Checks': 'max speed where r > 9 : 0 : 1'})
    expect('no material point' in text, text)


def test_usage_ladder():
    """scripts/verify: rows that pass, fall short as known, fail, and a run that
    is refused; orders over two runs."""
    path = directory('ladder')
    os.makedirs(path)
    ladder = os.path.join(path, 'ladder.toml')
    with open(ladder, 'w', encoding='utf-8') as file:
        file.write(f"""
[[problem]]
id = "wave"
title = "wave"
scene = "{scene('wave_xpic')[:-4]}"
runs = [{{set = {{"Verification/Checks" =
         "rms stress_rz : 1 : 0.5; spread density : 1"}}, h = 1.0}},
        {{set = {{"Verification/Checks" =
         "rms stress_rz : 0 : 0.5; spread density : 1"}}, h = 0.5}}]
rows = [{{check = "spread density"}},
        {{check = "spread density", error = 1e-9}},
        {{check = "spread density", error = 1e-9, known_error = 0.1, why = "a file"}},
        {{check = "spread speed"}},
        {{check = "rms stress_rz", run = 0}},
        {{check = "rms stress_rz", run = 0, error = 0.3, known_error = 1.0}},
        {{check = "rms stress_rz", run = 1, error = 1e-9, known_error = 1e-9}},
        {{check = "spread density", order = 99.0}},
        {{check = "spread density", order = 99.0, known_order = -9.0}}]
[[problem]]
id = "refused"
title = "refused"
scene = "{scene('wave_xpic')[:-4]}"
runs = [{{set = {{"Time/Courant number" = 7}}}}]
rows = [{{check = "max displacement_r"}}]
""".replace('=\n         ', '= '))
    script = os.path.join(arguments.scenes, '..', 'scripts', 'verify')
    line = [sys.executable, '-B', script, '--ladder', ladder, '--program',
            arguments.program, '--results', os.path.join(path, 'results')]
    done = subprocess.run(line, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)
    with open(os.path.join(path, 'results', 'table.csv'),
              encoding='utf-8') as file:
        rows = list(csv.DictReader(file))
    verdicts = [row['verdict'].split(' ')[0].strip(',') for row in rows]
    expect(verdicts == ['pass', 'FAIL', 'short', 'FAIL', 'FAIL', 'short',
                        'pass', 'FAIL', 'short', 'FAIL'],
           verdicts, done.stdout)
    expect(done.returncode == 1 and '10 rows: 2 pass, 3 fall' in done.stdout,
           done.stdout)
    expect('a file' in rows[2]['verdict'] and 'spread speed' in
           rows[3]['computed'] and 'status 1' in rows[-1]['computed'], rows)
    done = subprocess.run(line + ['--only', 'refused', '--list'], text=True,
                          stdout=subprocess.PIPE)
    expect(done.returncode == 0 and 'wave:' not in done.stdout, done.stdout)


# ---------------------------------------------------------------- bad input

def refused(words, name='jack', status=BAD_INPUT, **entries):
    """The scene with these entries is refused with a message that has all the
    words, within a second, and leaves no results."""
    path = directory('refused')
    text = run(status, scene(name), '--output-directory', path, **entries)
    for word in words:
        expect(word.lower() in text.lower(), f'"{word}" is not in:\n{text}')
    expect(not os.path.exists(os.path.join(path, 'history.csv')),
           'there are results')


def test_input_mistyped_entry():
    refused(['Soil/Layer 1/Friction angle'],
            **{'Soil/Layer 1/Friction angel': 30})


def test_input_out_of_range():
    refused(['Poisson ratio', '0.7', 'from 0 to 0.4999'],
            **{'Soil/Layer 1/Poisson ratio': 0.7})
    refused(['Courant number'], **{'Time/Courant number': 1.5})
    refused(['Velocity table'], **{'Rigid body/Velocity table': '0:1, 0.5'})


def test_input_contradictions():
    for words, entries in (
            (['Dilatancy angle', '40', 'Lower'],
             {'Soil/Layer 1/Dilatancy angle': 40}),
            (['Residual friction angle', 'exceeds', 'Lower'],
             {'Soil/Layer 1/Law': 'Mohr-Coulomb with softening',
              'Soil/Layer 1/Residual friction angle': 31}),
            (['Residual dilatancy angle', 'energy'],
             {'Soil/Layer 1/Law': 'Mohr-Coulomb with softening',
              'Soil/Layer 1/Friction angle': 40,
              'Soil/Layer 1/Dilatancy angle': 35,
              'Soil/Layer 1/Residual dilatancy angle': 35}),
            (['Porosity', '0.346405', '0.5'],
             {'Soil/Layer 1/Law': 'hypoplastic sand',
              'Soil/Layer 1/Porosity': 0.3}),
            (['Critical void ratio', 'order'],
             {'Soil/Layer 1/Law': 'hypoplastic sand',
              'Soil/Layer 1/Critical void ratio': 0.5}),
            (['Solid density', 'float'], {'Soil/Layer 1/Solid density': 900}),
            (['K0', 'Change'], {'Soil/Layer 1/K0': 9}),
            (['Top depth', 'layers'], {'Soil/Number of layers': 2}),
            (['Wall thickness', 'plug'], {'Rigid body/Wall thickness': 3.5}),
            (['even number'], {'Rigid body/Cells across the wall': 3}),
            (['Tip angle', 'Reduce'], {'Rigid body/Skirt length': 0.05}),
            (['Initial penetration', 'tip'],
             {'Rigid body/Initial penetration': 0.05}),
            (['End penetration', '0.4'], {'Time/End penetration': 0.4}),
            (['no end'], {'Time/End penetration': 0, 'Time/End time': 0}),
            (['no end'], {'Rigid body/Velocity': 0}),
            (['moves up', '0.375 m', 'stretch'],
             {'Rigid body/Velocity': -0.5, 'Time/End penetration': 0,
              'Time/End time': 1, 'Grid/Moving zone below tip': 10}),
            (['moving up', 'Upper zone'],
             {'Rigid body/Velocity': -0.5, 'Time/End penetration': 0,
              'Time/End time': 4, 'Grid/Upper zone': 'extending'}),
            (['lid', 'below the soil surface', '-1'],
             {'Rigid body/Lid thickness': 3, 'Rigid body/Skirt length': 2.5}),
            (['Lid thickness', 'only a caisson'],
             {'Rigid body/Lid thickness': 0.1, 'Rigid body/Kind': 'box'}),
            (['cone', 'partly above', '5.19'],
             {'Rigid body/Kind': 'cone', 'Rigid body/Skirt length': 6}),
            (['height of the cone', 'Skirt length'],
             {'Rigid body/Kind': 'cone'}),
            (['only grow'],
             {'Rigid body/Kind': 'cylinder', 'Rigid body/Velocity': -0.1,
              'Time/End penetration': 0, 'Time/End time': 1}),
            (['Outer radius', 'column', '0.1 m'],
             {'Rigid body/Kind': 'cylinder', 'Time/End penetration': 4.9,
              'Grid/Smallest row height': 0.1}),
            (['cylinder', 'Inner radius'],
             {'Rigid body/Kind': 'cylinder', 'Grid/Inner radius': 3.5}),
            (['cylinder', 'Adhesion'],
             {'Rigid body/Kind': 'cylinder',
              'Rigid body/Adhesion of the outer wall': 5}),
            (['Velocity table', 'increasing'],
             {'Rigid body/Velocity table': '0:0, 2:0.1, 1:0.1'}),
            (['Inner radius', 'Outer radius'], {'Grid/Inner radius': 8}),
            (['does not fit', 'Outer radius'],
             {'Rigid body/Outer diameter': 20}),
            (['does not fit', 'Top'], {'Rigid body/Skirt length': 6}),
            (['Bottom'], {'Grid/Bottom': 1}),
            (['Axis', 'roller'], {'Boundary conditions/Axis': 'free'}),
            (['Gravity', 'none'], {'Soil/Gravity': '1, -9'})):
        refused(words, **entries)


def test_input_checks_and_observations():
    """All messages: output_checks.cc."""
    refused(['Verification/Checks', 'no observation', 'total_force_N'],
            **{'Verification/Checks': 'final force : 0 : 1'})
    refused(['Verification/Observations', 'no quantity', 'speed'],
            **{'Verification/Observations': 'a = mean sped'})


def test_input_mesh_cannot_hold_the_travel():
    # too short a compressing zone: -5 + 0.5 + 1 leaves 3.5 m
    refused(['3.5 m', '3.7 m', 'Bottom', '-5.2'],
            **{'Time/End penetration': 4.2, 'Grid/Top': 9})
    refused(['Smallest row height', '0.4'],
            **{'Grid/Smallest row height': 0.4, 'Time/End penetration': 2.5})
    refused(['Moving zone below tip', 'at least'],
            **{'Grid/Moving zone below tip': 0.2})
    refused(['Top', 'extending'],
            **{'Grid/Upper zone': 'extending', 'Grid/Top': 2.5})
    # the advice is good: with the bottom that the message names it runs
    done = subprocess.run(
        command(scene('jack'), '--validate',
                **{'Grid/Smallest row height': 0.2,
                   'Time/End penetration': 3.2}),
        text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    advice = re.search(r'Grid/Bottom to about (\S+) m', done.stdout)
    expect(done.returncode == BAD_INPUT and advice, 'advice:', done.stdout)
    run(SUCCESS, scene('jack'), '--validate',
        **{'Grid/Smallest row height': 0.2, 'Time/End penetration': 3.2,
           'Grid/Bottom': float(advice.group(1)) - 0.3})


def test_input_files():
    expect('nowhere.prm' in run(BAD_INPUT, 'nowhere.prm'), 'missing file')
    expect('directory' in run(BAD_INPUT, arguments.directory).lower(),
           'a directory instead of a file')
    os.makedirs(arguments.directory, exist_ok=True)
    blocked = os.path.join(arguments.directory, 'a_file')
    with open(blocked, 'w', encoding='utf-8') as file:
        file.write('not a directory')
    text = run(BAD_INPUT, scene('jack'), '--output-directory',
               os.path.join(blocked, 'results'))
    expect('a_file' in text, text)
    if os.geteuid() != 0:  # root may write everywhere
        run(BAD_INPUT, scene('jack'), '--output-directory', '/proc/nothing')


def test_input_no_soil():
    path = directory('no_soil')
    text = run(BAD_INPUT, scene('block_slides'), '--output-directory', path,
               **{'Material points/Region left': 1.9,
                  'Material points/Region right': 1.9})
    expect('No material point' in text, text)


# ---------------------------------------------------------------- the state

def test_state_point_leaves_the_mesh():
    path = directory('lost')
    text = run(FAILURE, scene('block_slides'), '--output-directory', path,
               **{'Time/End time': 2, 'Output/Record interval': 0.1,
                  'Boundary conditions/Side': 'free'})
    for word in ('material point', 'left the mesh', 'began at', 'Likely cause'):
        expect(word in text, word, 'is not in', text)
    expect(len(history(path)) > 3, 'the rows so far are lost')


def test_state_not_finite():
    path = directory('nan')
    text = run(FAILURE, scene('jack'), '--output-directory', path,
               **{'Soil/Layer 1/Solid density': 1e308})
    for word in ('not finite', 'step', 'material point', 'began at',
                 'Likely cause'):
        expect(word in text, word, 'is not in', text)
    expect(len(history(path)) == 1, 'the first row is lost')


def test_input_step_too_large():
    text = jack(directory('step'), BAD_INPUT, **{'Time/Time step': 1})
    for word in ('Time/Time step', 'stability limit', 'Reduce'):
        expect(word in text, word, 'is not in', text)


def test_state_limiter():
    """Off or not needed: no firing. With a small k it fires, is counted, and
    holds the points beside the body to k H / dt."""
    entries = {'Time/End penetration': 0.52, 'Output/Record interval': 0.1}
    counts = []
    for on, k in (('false', 0.75), ('true', 0.75), ('true', 0.01)):
        path = directory('limiter')
        jack(path, **entries, **{'Method/Velocity limiter': on,
                                 'Method/Limiter factor': k})
        counts.append(summary(path)['limiter_count'])
        expect(counts[-1] == history(path)[-1]['limiter_count'], 'counts')
    expect(counts[0] == 0 and counts[1] == 0, 'needless firings:', counts)

    # a block hits the plane with 1 m/s: limited to 0.1 * 0.05 / 0.01 = 0.5
    path = directory('limited')
    run(SUCCESS, scene('block_slides'), '--output-directory', path,
        **{'Time/End time': 0.1, 'Time/Time step': 2e-4,
           'Method/Limiter factor': 0.01, 'Soil/Gravity': '50, -87',
           'Output/Record interval': 0.02, 'Verification/Checks': ''})
    rows = history(path)
    expect(rows[-1]['limiter_count'] > 100, 'firings', rows[-1])


def test_state_mass_floor():
    """A block slides into empty cells, where its nodes have little mass. With
    USL that is unstable, unless the mass floor is on (block_mass_floor.prm)."""
    path = directory('floor')
    text = run(FAILURE, scene('block_mass_floor'), '--output-directory', path,
               **{'Method/Mass floor': 'false'})
    expect('left the mesh' in text or 'finite' in text, text)
    path = directory('floor')
    run(SUCCESS, scene('block_mass_floor'), '--output-directory', path,
        **{'Output/Record interval': 0.02})
    expect(max(row['added_mass_kg'] for row in history(path)) > 0.,
           'no mass was added')


def test_state_instruction_sets_agree():
    rows = {}
    for name in ('SSE2', 'AVX2', 'AVX-512'):
        path = directory('isa_' + name)
        done = subprocess.run(
            command(scene('jack'), '--output-directory', path,
                    **{'Method/Instruction set': name,
                       'Output/Record interval': 0.05,
                       'Time/End penetration': 0.52}),
            text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode == BAD_INPUT and name != 'SSE2':
            expect('does not have it' in done.stdout, done.stdout)
            continue
        expect(done.returncode == SUCCESS, done.stdout)
        rows[name] = history(path)
    for name, other in rows.items():
        expect(len(other) == len(rows['SSE2']), name, 'rows')
        for a, b in zip(rows['SSE2'], other):
            for key in ('total_force_N', 'kinetic_energy_J', 'external_work_J'):
                error = abs(a[key] - b[key]) / max(1., abs(a[key]))
                expect(error < 1e-7, name, key, 'differs by', error)


def test_state_energy():
    """Work of the body, and little kinetic energy."""
    path = directory('energy')
    jack(path, **{'Output/Record interval': 0.05})
    rows = history(path)
    work = 0.
    for a, b in zip(rows, rows[1:]):
        work += b['total_force_N'] * (b['penetration_m'] - a['penetration_m'])
    last = rows[-1]
    expect(abs(last['external_work_J'] / work - 1.) < 0.02, 'external work',
           last['external_work_J'], 'against', work)
    expect(last['kinetic_energy_J'] < 0.03 * work, 'kinetic energy',
           last['kinetic_energy_J'], 'against', work)


# ---------------------------------------------------------------- stopping

def same_history(a, b, tolerance):
    expect(len(a) == len(b), 'rows:', len(a), 'and', len(b))
    for x, y in zip(a, b):
        for key in x:
            if key == 'time_step_s':
                continue
            scale = max(1., abs(x[key]))
            expect(abs(x[key] - y[key]) <= tolerance * scale, key, 'at t =',
                   x['time_s'], ':', x[key], 'and', y[key])


def test_stop_and_restart():
    """Stopped by a signal and continued, twice: the history of one run."""
    entries = {'Output/Record interval': 0.25, 'Time/End penetration': 0.7,
               'Verification/Observations':
               'a = max position_z; b = point stress_zz at 3 -1',
               'Verification/Checks': 'average a to 1 : 0 : 0.2;'
               'drift b : 1; drift penetration_m from 0.3 : 0.3'}
    whole = directory('whole')
    jack(whole, **entries)
    path = directory('pieces')
    status, n_stops, options = None, 0, []
    while status != SUCCESS:
        process = subprocess.Popen(
            command(scene('jack'), '--output-directory', path, *options,
                    **entries),
            text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        n_records = 0
        for line in process.stdout:
            n_records += line.startswith('pen')
            if n_stops < 2 and n_records == 2:
                process.send_signal(signal.SIGTERM)
                break
        rest = process.stdout.read()
        status = process.wait()
        if status != SUCCESS:
            expect(status == STOPPED, 'status', status, rest)
            expect('SIGTERM' in rest and '--restart' in rest, rest)
            expect(summary(path)['status'] == 'stopped', 'run.json')
            n_stops += 1
            options = ['--restart']
    expect(n_stops == 2, 'stopped', n_stops, 'times')
    same_history(history(whole), history(path), 1e-6)
    same_history(history(whole, 'observations'), history(path, 'observations'),
                 1e-6)
    results = []
    for of in (whole, path):
        with open(os.path.join(of, 'verification.json'), encoding='utf-8') as f:
            results.append([c['computed'] for c in json.load(f)])
    expect(all(abs(a - b) <= 1e-6 * max(1., abs(a))
               for a, b in zip(*results)), 'checks', results)
    for name in ('points.pvd', 'grid.pvd'):
        expect(open(os.path.join(path, name)).read().count('<DataSet') ==
               open(os.path.join(whole, name)).read().count('<DataSet'),
               name, 'lists other frames')


def test_stop_file():
    path = directory('stop_file')
    os.makedirs(path)
    process = subprocess.Popen(
        command(scene('jack'), '--output-directory', path,
                **{'Output/Record interval': 0.05,
                   # many seconds: the file is looked for twice a second
                   'Time/Courant number': 0.02}),
        text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    for line in process.stdout:
        if line.startswith('pen'):
            break
    with open(os.path.join(path, 'stop'), 'w', encoding='utf-8'):
        pass
    text = process.stdout.read()
    expect(process.wait() == STOPPED, 'status', process.returncode, text)
    expect(not os.path.exists(os.path.join(path, 'stop')), 'the file is left')


def flip_a_bit(path):
    """In the middle of the checkpoint that is valid."""
    with open(os.path.join(path, 'checkpoint.info'), encoding='utf-8') as info:
        name = re.search(r'^file (.*)$', info.read(), re.M).group(1)
    with open(os.path.join(path, name), 'r+b') as file:
        middle = file.seek(0, os.SEEK_END) // 2
        file.seek(middle)
        byte = file.read(1)[0]
        file.seek(middle)
        file.write(bytes([byte ^ 1]))


def test_stop_restart_is_refused():
    path = directory('none')
    text = jack(path, BAD_INPUT, '--restart')
    expect('no checkpoint' in text, text)
    path = directory('changed')
    process = subprocess.Popen(command(scene('jack'), '--output-directory', path),
                               text=True, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT)
    for line in process.stdout:
        if line.startswith('pen'):
            process.send_signal(signal.SIGINT)
            break
    process.stdout.read()
    expect(process.wait() == STOPPED, 'status', process.returncode)
    text = jack(path, BAD_INPUT, '--restart',
                **{'Soil/Layer 1/Friction angle': 31})
    expect('Friction angle' in text, text)
    flip_a_bit(path)
    text = jack(path, BAD_INPUT, '--restart')
    expect('is damaged' in text and 'HDF5' not in text, text)
    flip_a_bit(path)
    jack(path, SUCCESS, '--restart')


# ---------------------------------------------------------------- ranks

def on_ranks(n, status, *options, **entries):
    """Run the program on n ranks, expect the status, return its output."""
    environment = {'OMPI_ALLOW_RUN_AS_ROOT': '1',
                   'OMPI_ALLOW_RUN_AS_ROOT_CONFIRM': '1',
                   'OMPI_MCA_mpi_yield_when_idle': '1', **os.environ}
    done = subprocess.run(
        ['mpirun', '--oversubscribe', '--bind-to', 'none', '-np', str(n),
         *command(*options, **entries)],
        text=True, timeout=100, env=environment, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT)
    expect(done.returncode == status, n, 'ranks: status', done.returncode,
           'instead of', status, '\n', done.stdout)
    return done.stdout


def same_on_ranks(one, several):
    """The histories differ by rounding: 1e-9 of the largest value of a column,
    or of the work for what is a difference of works."""
    expect(len(one) == len(several), 'rows:', len(one), len(several))
    work = max(row['external_work_J'] for row in one)
    for key in one[0]:
        scale = max(abs(row[key]) for row in one)
        if key in ('gravity_work_J', 'energy_residual_J'):
            scale = max(scale, work)
        elif key == 'energy_residual':
            scale = 1.
        error = max(abs(a[key] - b[key]) for a, b in zip(one, several))
        expect(error <= 1e-9 * scale, key, 'differs by', error, 'of', scale)


def compare_ranks(name, numbers, least_repartitions, **entries):
    """The same scene on one rank and on others; >= 1,000 steps."""
    paths = {n: directory(f'{name}_{n}') for n in (1, *numbers)}
    jack(paths[1], **entries)
    expect(summary(paths[1])['steps'] >= 1000, 'too few steps')
    for n in numbers:
        text = on_ranks(n, SUCCESS, scene('jack'), '--output-directory',
                        paths[n], **entries)
        expect(text.count('100 %') == 1, 'all ranks print', text)
        same_on_ranks(history(paths[1]), history(paths[n]))
        one, several = summary(paths[1]), summary(paths[n])
        for key in ('material_points', 'body_points', 'cells', 'steps',
                    'held_back', 'limiter_count', 'points_lost',
                    'points_split', 'points_merged'):
            expect(one[key] == several[key], key, several[key], 'instead of',
                   one[key])
        expect(several['ranks'] == n, several['ranks'], 'ranks')
        expect(several['repartitions'] >= least_repartitions, 'only',
               several['repartitions'], 'repartitions')
    return summary(paths[1])


def test_ranks_agree():
    """The caisson travels over several rows, so that points change their
    ranks, and the parts are cut anew."""
    compare_ranks('ranks', (2, 4), 2, **{'Time/End penetration': 1})


def test_ranks_split_and_merge():
    one = compare_ranks('ranks_split', (2,), 1,
                        **{'Time/End penetration': 1,
                           'Material points/Split and merge': 'true'})
    expect(one['points_split'] > 100 and one['points_merged'] > 100,
           one['points_split'], 'split,', one['points_merged'], 'merged')


def test_ranks_restart():
    """A checkpoint of two ranks is continued on one and on three."""
    whole, stopped = directory('ranks_whole'), directory('ranks_stopped')
    entries = {'Output/Record interval': 0.05, 'Time/End penetration': 1}
    jack(whole, **entries)
    on_ranks(2, STOPPED, scene('jack'), '--output-directory', stopped,
             **entries, **{'Run control/Wall time limit': 0.2})
    for n in (1, 3):
        path = directory(f'ranks_restart_{n}')
        shutil.copytree(stopped, path)
        on_ranks(n, SUCCESS, scene('jack'), '--output-directory', path,
                 '--restart', **entries)
        same_history(history(whole), history(path), 1e-6)
        expect(summary(path)['material_points'] ==
               summary(whole)['material_points'], 'points')
    flip_a_bit(stopped)
    text = on_ranks(2, BAD_INPUT, scene('jack'), '--output-directory', stopped,
                    '--restart', **entries)
    expect(text.count('is damaged') == 1, text)


def test_ranks_verification():
    paths = [directory(f'ranks_verify_{n}') for n in (1, 2)]
    run(SUCCESS, scene('wave_series'), '--output-directory', paths[0])
    on_ranks(2, SUCCESS, scene('wave_series'), '--output-directory', paths[1])
    checks = []
    for path in paths:
        with open(os.path.join(path, 'verification.json'),
                  encoding='utf-8') as file:
            checks.append(json.load(file))
    expect(len(checks[0]) == len(checks[1]) > 5, 'checks')
    for a, b in zip(*checks):
        for key in a:
            same = (abs(a[key] - b[key]) < 1e-9
                    if isinstance(a[key], float) else a[key] == b[key])
            expect(same, key, 'is', b[key], 'instead of', a[key])
    for a, b in zip(*[history(path, 'observations') for path in paths]):
        for key in a:
            expect(abs(a[key] - b[key]) < 1e-9, key, a[key], b[key])
    on_ranks(2, FAILURE, scene('wave_series'), '--output-directory', paths[1],
             **{'Verification/Checks': 'final half : -4 : 0.03'})


def test_ranks_without_cells():
    """More ranks than cells."""
    text = on_ranks(8, SUCCESS, scene('two_fields'), '--output-directory',
                    directory('ranks_without_cells'),
                    **{'Grid/Cell width': 1, 'Grid/Cell height': 1,
                       'Verification/Checks': ''})
    expect('100 %' in text, text)


def test_ranks_failure_ends_all():
    """One rank loses a point, and does not leave the others waiting."""
    text = on_ranks(2, FAILURE, scene('block_slides'), '--output-directory',
                    directory('ranks_lost'),
                    **{'Time/End time': 2, 'Output/Record interval': 0.1,
                       'Boundary conditions/Side': 'free'})
    expect(text.count('failure: material point') == 1, text)


def test_ranks_bad_input_is_told_once():
    text = on_ranks(2, BAD_INPUT, scene('jack'),
                    **{'Soil/Layer 1/Frction angle': 31})
    expect(text.count('bad input') == 1 and 'Friction angle' in text, text)
    text = on_ranks(2, BAD_INPUT, scene('jack'), '--output-directory',
                    directory('ranks_bad'), **{'Time/Time step': 1})
    expect(text.count('bad input') == 1 and 'stability limit' in text, text)


# ---------------------------------------------------------------- user scenes

def at_rest(name, **entries):
    """The user scene with the body held still: 1,000 steps and more change
    nothing."""
    path = directory(name)
    zz = '8829*z'
    text = run(SUCCESS, os.path.join(arguments.scenes, name + '.prm'),
               '--output-directory', path,
               **{'Rigid body/Velocity': 0, 'Rigid body/Ramp time': 0,
                  'Time/End penetration': 0, 'Output/Frame penetrations': '',
                  'Output/Frame interval': 0, 'Output/Record interval': 100,
                  'Verification/Checks':
                  'max speed : 0 : 0.002; '
                  f'pointwise stress_zz : {zz} : 0.005; '
                  f'pointwise stress_rr : 0.5*{zz} : 0.005; '
                  f'pointwise stress_tt : 0.5*{zz} : 0.005', **entries})
    expect(text.count(': yes') == 4, text)
    expect(summary(path)['steps'] >= 1000, 'only', summary(path)['steps'],
           'steps')


def test_scenes_column():
    path = directory('column')
    run(SUCCESS, os.path.join(arguments.scenes, 'column.prm'),
        '--output-directory', path)
    with open(os.path.join(path, 'verification.json'), encoding='utf-8') as f:
        checks = {(c['mode'], c['quantity']): c for c in json.load(f)}
    expect(checks['max', 'displacement_z']['relative_error'] < 0.005, checks)
    expect(checks['pointwise', 'stress_ratio']['relative_error'] < 0.01, checks)


def test_scenes_jack_coarse_at_rest():
    at_rest('jack_coarse', **{'Time/End time': 4})


def test_scenes_jack_at_rest():
    at_rest('jack', **{'Time/End time': 4})


def test_scenes_warn_of_few_points():
    for points, warnings in (5, 1), (7, 0):
        text = run(SUCCESS, os.path.join(arguments.scenes, 'jack.prm'),
                   '--output-directory', directory('few_points'),
                   **{'Material points/Per direction in path': points,
                      'Time/End penetration': 0.502, 'Output/Error bar': '',
                      'Output/Frame penetrations': ''})
        expect(text.count('warning:') == warnings ==
               text.count('break loose'), text)


# ---------------------------------------------------------------- main

def main():
    global arguments
    parser = argparse.ArgumentParser()
    parser.add_argument('--program', required=True)
    parser.add_argument('--scenes', required=True)
    parser.add_argument('--directory', required=True)
    parser.add_argument('group', help='of the tests; a part of the name')
    arguments = parser.parse_args()
    arguments.program = os.path.abspath(arguments.program)
    arguments.directory = os.path.abspath(arguments.directory)
    tests = {name: test for name, test in globals().items()
             if name.startswith('test_' + arguments.group)}
    n_failed = 0
    for name, test in tests.items():
        start = time.time()
        try:
            test()
            print(f'{name}: passed, {time.time() - start:.1f} s', flush=True)
        except Failed as error:
            n_failed += 1
            print(f'{name}: FAILED: {error}', flush=True)
    if not tests:
        sys.exit('no test has this name')
    sys.exit(1 if n_failed else 0)


if __name__ == '__main__':
    main()
