#!/usr/bin/python3
"""Renders a Cartesian NRRD volume with VTK's CPU ray caster (vtkFixedPointVolumeRayCastMapper) as `quincunx render` does:
the same camera, transfer function, step in the world and light. To compare times and to look at transfer functions.

  bench/vtk_dvr.py data.nrrd --transfer data/transfer/cthead_clear.json --shade on -o picture.png

Needs the Debian package python3-vtk9 and, without an X server, xvfb and xauth: VTK shows through OpenGL what it cast on the
CPU. Prints one line of JSON. Times in milliseconds, over all timed frames of all views:
  cast_ms    the rays alone (RenderSubVolume)
  mapper_ms  all of the mapper: the preparation of a frame, the rays, the finished picture handed to OpenGL (GetTimeToDraw)
  render_ms  vtkRenderWindow.Render() by the clock
The first frame of a view, which also makes normals, tables and block bounds, is not among them.

What VTK does otherwise: it computes in 15-bit fixed point; a ray ends where less than 1/128 of what lies behind would show; normals are
central differences, rounded to a table of directions by which the light is looked up; blocks of 4 cells without opacity are skipped.
"""
import argparse
import gzip
import json
import math
import os
import shutil
import statistics
import sys
import time
import zlib

try:
    import vtk
except ImportError:
    sys.exit("vtk_dvr.py: found no module vtk, expected it: Debian package python3-vtk9, for /usr/bin/python3")

TYPES = {"uchar": vtk.VTK_UNSIGNED_CHAR, "uint8": vtk.VTK_UNSIGNED_CHAR, "short": vtk.VTK_SHORT, "int16": vtk.VTK_SHORT,
         "ushort": vtk.VTK_UNSIGNED_SHORT, "uint16": vtk.VTK_UNSIGNED_SHORT, "float": vtk.VTK_FLOAT}


def refuse(text):
    print(f"vtk_dvr.py: {text}", file=sys.stderr)
    sys.exit(2)


# Volumes

def nrrd_steps(fields, path):
    """The steps along x, y, z and the origin; axes that are not the world's are refused."""
    if "space directions" not in fields:
        return [float(s) for s in fields["spacings"].split()], [0.0, 0.0, 0.0]
    triple = lambda text: [float(s) for s in text.strip("()").split(",")]
    axes = [triple(text) for text in fields["space directions"].split()]
    if any(axes[a][b] != 0.0 for a in range(3) for b in range(3) if a != b) or any(axes[a][a] <= 0.0 for a in range(3)):
        refuse(f"{path}: space directions {fields['space directions']}; expected positive ones along x, y and z")
    return [axes[a][a] for a in range(3)], triple(fields.get("space origin", "(0,0,0)"))


def read_volume(path):
    """A vtkImageImport, which owns the samples. Cartesian, attached header, raw or gzip, little endian."""
    with open(path, "rb") as file:
        header, _, samples = file.read().partition(b"\n\n")
    pairs = [line.split(": ", 1) for line in header.decode("latin-1").split("\n") if ": " in line and line[0] != "#"]
    fields = {key: value.strip() for key, value in pairs}
    sizes = [int(s) for s in fields.get("sizes", "").split()]
    kind, encoding = TYPES.get(fields.get("type")), fields.get("encoding")
    if len(sizes) != 3 or kind is None or encoding not in ("raw", "gzip") or fields.get("endian") == "big":
        refuse(f"{path}: expected a Cartesian NRRD volume, raw or gzip, little endian, of one of {', '.join(TYPES)}")
    if encoding == "gzip":
        samples = gzip.decompress(samples)
    steps, origin = nrrd_steps(fields, path)
    source = vtk.vtkImageImport()
    source.SetDataScalarType(kind)
    source.SetWholeExtent(0, sizes[0] - 1, 0, sizes[1] - 1, 0, sizes[2] - 1)
    source.SetDataExtentToWholeExtent()
    source.SetDataSpacing(steps)
    source.SetDataOrigin(origin)
    expected = math.prod(sizes) * vtk.vtkDataArray.GetDataTypeSize(kind)
    if len(samples) != expected:
        refuse(f"{path}: found {len(samples)} bytes of samples, expected {expected}")
    source.CopyImportVoidPointer(samples, len(samples))
    source.Update()
    return source


# Transfer functions

def linear_color(point):
    """[value, "#rrggbb"] in sRGB or [value, r, g, b] linear: linear r, g, b."""
    if not isinstance(point[1], str):
        return point[1:4]
    parts = [int(point[1][i:i + 2], 16) / 255.0 for i in (1, 3, 5)]
    return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]


def make_property(path, cell, shade, ambient):
    with open(path) as file:
        transfer = json.load(file)
    colors, opacities = vtk.vtkColorTransferFunction(), vtk.vtkPiecewiseFunction()
    for point in transfer["colors"]:
        colors.AddRGBPoint(point[0], *linear_color(point))
    for value, opacity in transfer["opacities"]:
        opacities.AddPoint(value, opacity)
    look = vtk.vtkVolumeProperty()
    look.SetColor(colors)
    look.SetScalarOpacity(opacities)
    look.SetScalarOpacityUnitDistance(transfer.get("unit", cell))
    look.SetInterpolationTypeToLinear()
    look.SetShade(shade)
    look.SetAmbient(ambient)
    look.SetDiffuse(1.0 - ambient)
    look.SetSpecular(0.0)
    return look


# Cameras

def framing_camera(bounds, azimuth, elevation, zoom, width, height):
    """That of render/camera.cpp for a volume along the world's axes: eye, target, up, fov."""
    a, e, tan_y = math.radians(azimuth), math.radians(elevation), math.tan(math.radians(15.0))
    tan_x = tan_y * width / height
    up = [-math.sin(a) * math.sin(e), math.cos(a) * math.sin(e), math.cos(e)]
    backward = [math.sin(a) * math.cos(e), -math.cos(a) * math.cos(e), math.sin(e)]
    right = [math.cos(a), math.sin(a), 0.0]
    target = [0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]) for axis in range(3)]
    half = [0.5 * (bounds[2 * axis + 1] - bounds[2 * axis]) for axis in range(3)]
    distance = 0.0
    for corner in range(8):
        c = [half[axis] if corner >> axis & 1 else -half[axis] for axis in range(3)]
        dot = lambda v: sum(v[axis] * c[axis] for axis in range(3))
        distance = max(distance, max(abs(dot(right)) / tan_x, abs(dot(up)) / tan_y) / 0.95 + dot(backward))
    distance = max(distance, 1.01 * math.hypot(*half))
    return {"eye": [target[axis] + distance * backward[axis] for axis in range(3)], "target": target, "up": up,
            "fov": 2.0 * math.degrees(math.atan(tan_y / zoom))}


def cameras(flags, bounds):
    if flags.camera:
        with open(flags.camera) as file:
            return [{"up": [0.0, 0.0, 1.0], "fov": 30.0, **json.load(file)}]
    return [framing_camera(bounds, flags.azimuth + 360.0 * view / flags.views, flags.elevation, flags.zoom, *flags.size)
            for view in range(flags.views)]


def place(renderer, camera):
    seen = renderer.GetActiveCamera()
    seen.SetPosition(camera["eye"])
    seen.SetFocalPoint(camera["target"])
    seen.SetViewUp(camera["up"])
    seen.SetViewAngle(camera["fov"])
    renderer.ResetCameraClippingRange()


# Frames

def make_scene(flags, source):
    """The window, its renderer and the mapper."""
    cell = min(source.GetDataSpacing())
    mapper = vtk.vtkFixedPointVolumeRayCastMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.SetNumberOfThreads(flags.threads)
    mapper.AutoAdjustSampleDistancesOff()
    mapper.LockSampleDistanceToInputSpacingOff()
    mapper.SetSampleDistance(flags.step * cell)
    mapper.SetInteractiveSampleDistance(flags.step * cell)
    mapper.SetImageSampleDistance(1.0)
    mapper.IntermixIntersectingGeometryOff()
    volume = vtk.vtkVolume()
    volume.SetMapper(mapper)
    volume.SetProperty(make_property(flags.transfer, cell, flags.shade == "on", flags.ambient))
    renderer = vtk.vtkRenderer()
    renderer.AddVolume(volume)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(*flags.size)
    window.SwapBuffersOff()
    window.AddRenderer(renderer)
    return window, renderer, mapper


def measure(window, renderer, mapper, frames, times):
    """Adds `frames` timed frames of each kind after one that is not timed."""
    window.Render()
    for _ in range(frames):
        renderer.GetActiveCamera().Modified()
        start = time.perf_counter()
        window.Render()
        times["render_ms"].append(1e3 * (time.perf_counter() - start))
        times["mapper_ms"].append(1e3 * mapper.GetTimeToDraw())
        start = time.perf_counter()
        mapper.RenderSubVolume()
        times["cast_ms"].append(1e3 * (time.perf_counter() - start))


def write_picture(window, path):
    """The window as an sRGB PNG: the colours in it are linear."""
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    picture = grab.GetOutput()
    encode = lambda c: 12.92 * c if c <= 0.0031308 else 1.055 * c ** (1.0 / 2.4) - 0.055
    table = bytes(round(255.0 * encode(i / 255.0)) for i in range(256))
    encoded = bytes(memoryview(picture.GetPointData().GetScalars())).translate(table)
    width, height, _ = picture.GetDimensions()
    source = vtk.vtkImageImport()
    source.SetDataScalarTypeToUnsignedChar()
    source.SetNumberOfScalarComponents(3)
    source.SetWholeExtent(0, width - 1, 0, height - 1, 0, 0)
    source.SetDataExtentToWholeExtent()
    source.CopyImportVoidPointer(encoded, len(encoded))
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()
    if writer.GetErrorCode() != 0:
        refuse(f"{path}: {vtk.vtkErrorCode.GetStringFromErrorCode(writer.GetErrorCode())}; expected a place for a PNG file")


def parse_flags():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("volume", help="Cartesian NRRD file")
    parser.add_argument("--transfer", required=True, help="transfer function, JSON")
    parser.add_argument("--size", type=int, nargs=2, default=[512, 512])
    parser.add_argument("--step", type=float, default=1.0, help="of the samples, in the shortest voxel steps")
    parser.add_argument("--shade", choices=["on", "off"], default="on")
    parser.add_argument("--ambient", type=float, default=0.2)
    parser.add_argument("--camera", help="camera file of quincunx; instead of the next four")
    parser.add_argument("--azimuth", type=float, default=30.0)
    parser.add_argument("--elevation", type=float, default=10.0)
    parser.add_argument("--zoom", type=float, default=1.0)
    parser.add_argument("--views", type=int, default=1, help="views, their azimuths equally apart")
    parser.add_argument("--repeat", type=int, default=9, help="timed frames of each view")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("-o", "--output", help="PNG file, of the first view")
    return parser.parse_args()


def main():
    flags = parse_flags()
    if "DISPLAY" not in os.environ:
        if not shutil.which("xvfb-run"):
            refuse("found neither an X server (DISPLAY) nor xvfb-run, expected one: Debian packages xvfb and xauth")
        os.execvp("xvfb-run", ["xvfb-run", "-a", sys.executable, *sys.argv])
    vtk.vtkMultiThreader.SetGlobalMaximumNumberOfThreads(flags.threads)
    source = read_volume(flags.volume)
    window, renderer, mapper = make_scene(flags, source)
    times = {"cast_ms": [], "mapper_ms": [], "render_ms": []}
    views = cameras(flags, source.GetOutput().GetBounds())
    for camera in views:
        place(renderer, camera)
        measure(window, renderer, mapper, flags.repeat, times)
        if flags.output and camera is views[0]:
            write_picture(window, flags.output)
    summary = {name: {"median": round(statistics.median(ms), 2), "min": round(min(ms), 2)} for name, ms in times.items()}
    print(json.dumps({"volume": flags.volume, "transfer": flags.transfer, "size": flags.size, "step": flags.step, "shade": flags.shade,
                      "threads": flags.threads, "views": len(views), "frames": len(times["cast_ms"]), **summary,
                      "camera": views[0], "vtk": vtk.vtkVersion.GetVTKVersion()}))


if __name__ == "__main__":
    try:
        main()
    except (OSError, EOFError, zlib.error, KeyError, ValueError) as error:  # a file that is not there, or is none of these
        refuse(f"{type(error).__name__}: {error}; expected a volume, a transfer function and a camera that can be read")
