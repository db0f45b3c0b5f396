#!/usr/bin/python3
"""Volume rendering beside VTK's CPU ray caster, as a table: the same volumes, camera, transfer functions, step and light, in turns.

  bench/vtk_compare.py FOLDER    FOLDER holds cthead.nrrd, mri_head.nrrd, aneurism.nrrd, bunny_ct_256.nrrd, vhf_pelvis.nrrd (Cartesian)

Needs what bench/vtk_dvr.py needs, and build/release/quincunx. Each round runs every program once, five frames each after one that warms up;
a figure is the median over the rounds of the runs' medians. VTK's is cast_ms, the rays alone; ours the passes by the device's timestamps.
"""
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

VOLUMES = ["cthead", "mri_head", "aneurism", "bunny_ct_256", "vhf_pelvis"]
ROUNDS = 3
PROGRAM = "build/release/quincunx"


def refuse(text):
    print(f"vtk_compare.py: {text}", file=sys.stderr)
    sys.exit(2)


def run(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        refuse(f"{' '.join(command)}: {done.stderr.strip()}")
    return done.stdout


def vtk_ms(volume, function):
    out = run(["/usr/bin/python3", "bench/vtk_dvr.py", volume, "--transfer", function, "--shade", "on", "--repeat", "5"])
    return json.loads(out)["cast_ms"]["median"]


def our_ms(volume, function):
    return json.loads(run([PROGRAM, "render", volume, "--tf", function, "--repeat", "5", "--json", "--quiet"]))["trace_ms"]["median"]


def main():
    if len(sys.argv) != 2 or not pathlib.Path(sys.argv[1]).is_dir():
        refuse("found no folder of volumes, expected: bench/vtk_compare.py FOLDER")
    folder = pathlib.Path(sys.argv[1])
    print("| volume | function | VTK, ms | trilinear, ms | VTK / trilinear | bcc7 on a quarter of the samples, ms | bcc7 / VTK |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        for name in VOLUMES:
            cartesian, bcc = str(folder / f"{name}.nrrd"), f"{scratch}/{name}.nrrd"
            run([PROGRAM, "convert", cartesian, bcc, "--lattice", "bcc", "--encoding", "raw", "--quiet"])
            for kind in ["opaque", "clear"]:
                function = f"data/transfer/{name}_{kind}.json"
                rounds = [(vtk_ms(cartesian, function), our_ms(cartesian, function), our_ms(bcc, function)) for _ in range(ROUNDS)]
                vtk, trilinear, bcc7 = (statistics.median(column) for column in zip(*rounds))
                print(f"| {name} | {kind} | {vtk:.0f} | {trilinear:.0f} | {vtk / trilinear:.1f} | {bcc7:.0f} | {bcc7 / vtk:.2f} |", flush=True)


main()
