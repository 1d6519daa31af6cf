#include "field_arguments.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <thread>

#include "choice.hpp"
#include "commands.hpp"
#include "field_vdb.hpp"
#include "voxel_image.hpp"

namespace blum::app {

void add_field_options(CLI::App& command, FieldArguments& arguments) {
  FieldOptions& options = arguments.options;
  command
      .add_option("MODEL", arguments.model,
                  "OFF, OBJ, STL or PLY: any surface, open or not, or points alone;\n"
                  "or a voxel image: NRRD (.nrrd, .nhdr)")
      ->required();
  command
      .add_option("--resolution", arguments.resolution,
                  "N voxels along the longest side (cubes), or NX,NY,NZ;\n"
                  "needed for a surface; a voxel image has its own grid")
      ->delimiter(',')
      ->expected(1, 3)
      ->check(kDigits);
  command
      .add_option("--box", arguments.box,
                  "X0,Y0,Z0,X1,Y1,Z1 (default: the model's box and a tenth more on every side)")
      ->delimiter(',')
      ->expected(6);
  command.add_option("--band", options.band,
                     "Only samples within this distance of the surface; others get none");
  command
      .add_option("--order", arguments.order,
                  "The K nearest faces of each sample, instead of the nearest vertex, edge or face")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command.add_flag("--signed", arguments.is_signed,
                   "Negative inside, exactly; the mesh must bound a solid");
  command.add_option("--threshold", arguments.threshold,
                     "Of a voxel image: distances to the voxels of at least this value\n"
                     "(default: to those that are not 0)");
  command
      .add_option_function<std::string>(
          "--backend",
          [&arguments](const std::string& name) {
            if (name == "auto") arguments.backend.reset();
            for (const FieldBackend b : {FieldBackend::kCpu, FieldBackend::kEgl,
                                         FieldBackend::kOsmesa, FieldBackend::kBrute}) {
              if (name == field_backend_name(b)) arguments.backend = b;
            }
          },
          "auto: OpenGL where EGL has a driver for hardware, else the CPU, as for --signed;\n"
          "cpu; egl or osmesa: OpenGL; brute: slow and simple")
      ->check(CLI::IsMember({"auto", "cpu", "egl", "osmesa", "brute"}))
      ->default_str("auto");
  command
      .add_option("--method", arguments.method,
                  "Of OpenGL: fragments; gather (needs OpenGL 4.3); havoc: distance meshes;\n"
                  "difi: linear factorization of distance vectors")
      ->transform(
          choice(std::map<std::string, FieldMethod>{{"fragments", FieldMethod::kFragments},
                                                    {"gather", FieldMethod::kGather},
                                                    {"havoc", FieldMethod::kDistanceMeshes},
                                                    {"difi", FieldMethod::kLinearFactorization}}))
      ->default_str("fragments");
  command
      .add_option("--mesh-error", arguments.mesh_error,
                  "Of havoc's meshes, in units of the smallest spacing: 0.001 to 1000")
      ->default_str("0.5");
  command
      .add_option("--cull", arguments.culling,
                  "What to leave out early, with commas between; it changes no distance by\n"
                  "more than the bound:\n"
                  "blocks, domains; OpenGL instead of blocks: sweep, clamp (with sweep), ranges;\n"
                  "none (default: blocks,domains)")
      ->delimiter(',')
      ->check(CLI::IsMember({"blocks", "domains", "sweep", "clamp", "ranges", "none"}));
  command.add_option(
      "-o,--output", arguments.output,
      has_vdb() ? "FILE.vti, FILE.nrrd, FILE.npy or FILE.vdb" : "FILE.vti, FILE.nrrd or FILE.npy");
  command.add_option("--slice", arguments.slice, "Write a slice as a picture to this PNG file");
  command.add_option("--slice-axis", arguments.slice_axis, "The slice's axis: x, y or z")
      ->transform(choice(std::map<std::string, int>{{"x", 0}, {"y", 1}, {"z", 2}}))
      ->default_str("z");
  command.add_option("--slice-index", arguments.slice_index, "The slice (default: the middle one)")
      ->check(kDigits);
  command.add_flag("--dry-run", arguments.is_dry_run,
                   "Print grid, sites and memory, and compute nothing");
  options.threads = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 1024);
  command
      .add_option("--threads", options.threads,
                  "The result does not depend on it (default: the number of cores)")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command.footer(
      R"(The distance of every sample is within the bound that is printed. OpenGL only proposes the
site of a sample: its distance is computed in double, and it is at most the printed regret farther
than the nearest one.
.vti files hold distances, site ids and sides; .nrrd and .npy distances alone (FILE.npy.json says
where the samples are). Ids: vertices as in the file, then edges, then faces.
Of a voxel image: the nearest feature voxel of every voxel, exactly, and the distance between their
centres; ids are numbers of voxels, x fastest.

Examples:
  blum field part.stl --resolution 128 -o part.vti
  blum field part.stl --resolution 256 --signed --band 0.5 -o part.nrrd
  blum field scan.ply --resolution 200,100,50 --box 0,0,0,4,2,1 -o scan.npy
  blum field part.stl --resolution 64 --order 3 -o nearest3.vti
  blum field part.stl --resolution 256 --signed --slice part.png --slice-axis x
  blum field part.stl --resolution 128 --backend egl --method difi --cull domains,sweep,clamp \
      -o part.vti
  blum field part.stl --resolution 1024 --dry-run
  blum field labels.nrrd -o distance.vti)");
}

Result<std::string> resolve_backend(FieldArguments& arguments) {
  FieldOptions& options = arguments.options;
  options.method = arguments.method.value_or(options.method);
  options.mesh_error = arguments.mesh_error.value_or(options.mesh_error);
  if (!arguments.culling.empty()) {
    const auto has = [&](const char* name) {
      return std::ranges::find(arguments.culling, name) != arguments.culling.end();
    };
    options.culling = {has("blocks"), has("domains"), has("sweep"), has("clamp"), has("ranges")};
  }
  if (arguments.backend) {
    options.backend = *arguments.backend;
    if (!is_opengl(options.backend)) return std::string("as asked");
    const Result<FieldDriver> driver = field_driver(options.backend);
    if (!driver) return driver.error();
    return driver.value().renderer + ", OpenGL " + driver.value().version + ", " +
           field_method_name(options.method);
  }
  if (arguments.order > 1) {
    return std::string("auto: several sites a sample are found by the CPU alone");
  }
  // Sides follow from distances to the nearest site, which an OpenGL driver can spoil.
  if (arguments.is_signed) return std::string("auto: signs by the CPU rest on no driver");
  const BackendChoice choice = choose_backend();
  options.backend = choice.backend;
  return "auto: " + choice.reason;
}

std::string resolved_problem(const FieldArguments& a) {
  if (!is_opengl(a.options.backend)) {
    const std::string backend = field_backend_name(a.options.backend);
    const char* wrong = a.method ? "--method" : a.mesh_error ? "--mesh-error" : nullptr;
    if (wrong != nullptr) {
      return std::string(wrong) + " is for --backend egl or osmesa; the backend is " + backend;
    }
  }
  return options_problem(a.options);
}

namespace {

/// Of options that are for surfaces alone, or for voxel images.
std::string model_problem(const FieldArguments& a) {
  if (!is_voxel_image(a.model)) {
    if (a.threshold) return "--threshold is for voxel images (.nrrd, .nhdr)";
    return a.resolution.empty() ? "--resolution is required" : "";
  }
  if (!has_voxel_images()) return "this program was built without Teem: " + a.model;
  const char* wrong = !a.resolution.empty() ? "--resolution"
                      : !a.box.empty()      ? "--box"
                      : a.order > 1         ? "--order"
                      : a.is_signed         ? "--signed"
                      : a.backend           ? "--backend"
                      : a.method            ? "--method"
                      : a.mesh_error        ? "--mesh-error"
                      : !a.culling.empty()  ? "--cull"
                                            : nullptr;
  if (wrong != nullptr) return std::string(wrong) + " is for surfaces, not for voxel images";
  if (a.threshold && std::isnan(*a.threshold)) return "--threshold: not a number";
  return {};
}

}  // namespace

std::string arguments_problem(const FieldArguments& a) {
  namespace fs = std::filesystem;
  if (std::string problem = model_problem(a); !problem.empty()) return problem;
  if (a.resolution.size() == 2) return "--resolution: one number or three";
  if (std::ranges::find(a.resolution, 0u) != a.resolution.end()) return "--resolution: 0";
  if (!(a.options.band >= 0)) return "--band: not a distance";
  if (a.order > 1 && is_opengl(a.backend.value_or(FieldBackend::kCpu))) {
    return "--order: the OpenGL backends find the nearest site alone";
  }
  if (a.culling.size() > 1 && std::ranges::find(a.culling, "none") != a.culling.end()) {
    return "--cull: none excludes the others";
  }
  if (a.order > 1 && a.is_signed) return "--order and --signed exclude each other";
  if (a.output.empty() && a.slice.empty() && !a.is_dry_run) {
    return "nothing to write: give -o FILE, --slice FILE or --dry-run";
  }
  if (!a.output.empty() && output_files(a.output).empty()) {
    return "--output: not .vti, .nrrd, .npy or .vdb: " + a.output;
  }
  if (is_vdb(a.output)) {
    if (const std::string why = why_no_vdb(); !why.empty())
      return "--output: " + why + ": " + a.output;
  }
  if (is_vdb(a.output) && a.order > 1) return "--output: a .vdb file holds one value a sample";
  std::vector<fs::path> files = output_files(a.output);
  if (!a.slice.empty()) files.emplace_back(a.slice);
  for (const fs::path& file : files) {
    std::error_code ignored;
    if (fs::equivalent(file, a.model, ignored)) return "the model would be overwritten";
  }
  if (a.resolution.size() == 3)
    return slice_problem(a, {a.resolution[0], a.resolution[1], a.resolution[2]});
  return {};
}

std::string slice_problem(const FieldArguments& a, const std::array<std::uint32_t, 3>& size) {
  const bool is_beyond =
      a.slice_index && *a.slice_index >= size[static_cast<std::size_t>(a.slice_axis)];
  return is_beyond ? "--slice-index: beyond the grid" : "";
}

Result<VoxelGrid> grid_of(const FieldArguments& a, const Box3& model) {
  Box3 box = model;
  double longest = 0;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, model.hi[axis] - model.lo[axis]);
  if (!a.box.empty()) {
    box = {{a.box[0], a.box[1], a.box[2]}, {a.box[3], a.box[4], a.box[5]}};
  } else {
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] -= 0.1 * longest;
      box.hi[axis] += 0.1 * longest;
    }
  }
  std::array<std::uint32_t, 3> size{};
  const bool is_solid = box.lo.x < box.hi.x && box.lo.y < box.hi.y && box.lo.z < box.hi.z;
  if (a.resolution.size() == 3 || !is_solid) {
    size.fill(a.resolution[0]);  // make_grid says what is wrong with the box
    std::ranges::copy(a.resolution, size.begin());
  } else {
    // Cubes: the other sides are widened to whole numbers of them.
    double side = 0;
    for (int axis = 0; axis < 3; ++axis) side = std::max(side, box.hi[axis] - box.lo[axis]);
    const double cube = side / a.resolution[0];
    for (int axis = 0; axis < 3; ++axis) {
      const double extent = box.hi[axis] - box.lo[axis];
      const double whole = std::clamp(std::ceil(extent / cube * (1 - 1e-12)), 1.0, 0x1p21);
      size[axis] = static_cast<std::uint32_t>(whole);
      const double more = std::max(0.0, 0.5 * (whole * cube - extent));
      box.lo[axis] -= more;
      box.hi[axis] += more;
    }
  }
  Result<VoxelGrid> grid = make_grid(box, size);
  const std::string problem = slice_problem(a, size);
  if (grid && !problem.empty()) return Error{ErrorCode::kBadArgument, problem, {}, {}};
  return grid;
}

}  // namespace blum::app
