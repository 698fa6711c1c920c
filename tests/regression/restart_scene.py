"""A small run that uses much of what a restart must bring back, and how two runs are compared."""
import glob
import os
import re
import sys

try:
    import h5py
    import numpy
    import yaml
except ImportError as error:
    print(f"not tested: {error}")
    sys.exit(77)


def deck(name, *, end=0.6, runrsf=40, d3dump=0, plot=0.02, columns=24, rows=16, mass=10.0, glstat=0.01, histories=True, more=""):
    """Water that flows through a box of computation over a floor with friction; a rigid plate falls beside it."""
    nodes = [(0.05 + 0.1 * i, 0.05 + 0.1 * j) for j in range(rows) for i in range(columns)]
    text = "*KEYWORD\n*TITLE\n" + name + "\n*NODE\n"
    text += "".join(f"{k},{x:.3f},{y:.3f},0.\n" for k, (x, y) in enumerate(nodes, 1))
    text += "90001,-9.,-0.025,-2.\n90002,9.,-0.025,-2.\n90003,9.,-0.025,2.\n90004,-9.,-0.025,2.\n"
    text += "90011,5.,2.,-.5\n90012,6.,2.,-.5\n90013,6.,2.1,.5\n90014,5.,2.1,.5\n"
    text += "*ELEMENT_SPH\n" + "".join(f"{k},1,{mass}\n" for k in range(1, len(nodes) + 1))
    text += "*ELEMENT_SHELL\n1,2,90001,90002,90003,90004\n2,3,90011,90012,90013,90014\n"
    text += ("*PART\nwater\n1,1,1,1,1\n*PART\nfloor\n2,2,2\n*PART\nplate\n3,2,3\n*SECTION_SPH\n1,1.2,0.8,1.2\n*SECTION_SHELL\n2,2\n0.05\n"
             "*MAT_NULL\n1,1000.,-1.E20,0.1\n*EOS_LINEAR_POLYNOMIAL\n1,0.,9.E5\n*MAT_RIGID\n2,7850.,2.1E11,0.3\n1,7,7\n"
             "*MAT_RIGID\n3,7850.,2.1E11,0.3\n1,6,7\n*HOURGLASS\n1,0,0,0,1.E-20,0.1\n*DEFINE_BOX\n1,0.8,9.,-9.,9.,-9.,9.\n*CONTROL_SPH\n1,1,1.E20,2\n"
             "*LOAD_BODY_Y\n1\n*DEFINE_CURVE\n1\n0.,9.81\n9.,9.81\n*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n0.2,0.1,1.,0.,10.\n10.\n"
             f"*CONTROL_TERMINATION\n{end}\n*CONTROL_TIMESTEP\n0.,0.9\n*INITIAL_VELOCITY\n0\n1.5,0.,0.\n")
    text += "".join(f"*DATABASE_{kind}\n{value}\n" for kind, value in
                    (("BINARY_D3PLOT", plot), ("GLSTAT", glstat * histories), ("MATSUM", 0.013 * histories), ("RCFORC", 0.01 * histories),
                     ("SPHOUT", 0.05 * histories), ("BINARY_RUNRSF", runrsf), ("BINARY_D3DUMP", d3dump)) if value)
    text += "*DATABASE_HISTORY_SPH\n1,30,200\n" + more + "*END\n"
    with open(name + ".k", "w") as file:
        file.write(text)


def arrays(file, below="/"):
    """Every dataset of an HDF5 file by its path."""
    found = {}
    with h5py.File(file, "r") as h5:
        h5[below].visititems(lambda path, item: found.__setitem__(path, item[()]) if isinstance(item, h5py.Dataset) else None)
    return found


def cycle_of(file):
    with open(file, "rb") as stream:
        stream.seek(-74, os.SEEK_END)
        return int(re.search(rb"cycle +(\d+)", stream.read()).group(1))


def latest(folder):
    return max(glob.glob(f"{folder}/restart/*.h5"), key=lambda file: (cycle_of(file), os.path.getmtime(file)))


def differing(a, b):
    """Paths of arrays that do not have the same bits."""
    return sorted(path for path in set(a) | set(b)
                  if path not in a or path not in b or numpy.asarray(a[path]).tobytes() != numpy.asarray(b[path]).tobytes())


def text_of(file):
    """Without dates, and without the one number that states how fast the machine is."""
    with open(file) as stream:
        text = stream.read()
    return re.sub(r"time per zone cycle.*", "", re.sub(r"date .*", "", text))


def field_values(file):
    """All arrays of a field file as VTK reads them."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader

    reader = vtkXMLPolyDataReader() if file.endswith(".vtp") else vtkXMLUnstructuredGridReader()
    reader.SetFileName(file)
    reader.Update()
    data = reader.GetOutput()
    found = {"points": vtk_to_numpy(data.GetPoints().GetData())}
    for kind, part in (("point", data.GetPointData()), ("cell", data.GetCellData())):
        for k in range(part.GetNumberOfArrays()):
            found[f"{kind} {part.GetArrayName(k)}"] = vtk_to_numpy(part.GetArray(k))
    return found


def differences(a, b, texts=("glstat", "matsum", "rcforc", "sphout")):
    """What two folders of results differ in; empty where they are alike."""
    out = [f"state: {path}" for path in differing(arrays(latest(a), "/state"), arrays(latest(b), "/state"))]
    out += [f"history.h5: {path}" for path in differing(arrays(f"{a}/history.h5"), arrays(f"{b}/history.h5"))]
    out += [name for name in texts if text_of(f"{a}/{name}") != text_of(f"{b}/{name}")]
    if open(f"{a}/fields.pvd").read() != open(f"{b}/fields.pvd").read():
        out.append("fields.pvd")
    names = [sorted(os.path.basename(file) for file in glob.glob(f"{folder}/fields/*")) for folder in (a, b)]
    if names[0] != names[1]:
        out.append(f"names of field files: {set(names[0]) ^ set(names[1])}")
    for name in names[0] if names[0] == names[1] else []:
        if open(f"{a}/fields/{name}", "rb").read() == open(f"{b}/fields/{name}", "rb").read():
            continue
        out.append(f"{name} is packed otherwise")
        out += [f"{name}: {path}" for path in differing(field_values(f"{a}/fields/{name}"), field_values(f"{b}/fields/{name}"))]
    return out + summary_differences(a, b)


def summary_differences(a, b):
    left_out = {"wall_seconds", "cpu_seconds", "writer_cpu_seconds", "ns_per_particle_step", "elapsed_ns_per_particle_step", "peak_memory_bytes", "passes",
                "restarts", "restart_notes", "restart_file", "threads", "deck", "output", "read_seconds"}
    one, other = (yaml.safe_load(open(f"{folder}/summary.yaml")) for folder in (a, b))
    return [f"summary: {key}" for key in sorted(set(one) | set(other)) if key not in left_out and one.get(key) != other.get(key)]
