// A compute shader: a work group takes a block of samples, a sample looks at the block's sites.
#include <algorithm>

#include "gl_field.hpp"
#include "gl_program.hpp"
#include "scan_block.hpp"

namespace blum::detail {
namespace {

constexpr const char* kGather = R"(#version 430 core
layout(local_size_x = 8, local_size_y = 8, local_size_z = 8) in;
layout(std430, binding = 0) readonly buffer Sites { vec4 texel[]; };
layout(std430, binding = 1) readonly buffer Lists { uint place[]; };
layout(std430, binding = 2) readonly buffer Blocks { uint block[]; };
layout(std430, binding = 3) buffer Ids { uint nearest[]; };
layout(std430, binding = 4) buffer Least { float least[]; };
uniform uvec3 size;
uniform uint slab;
uniform vec3 origin, spacing;
void main() {
  uint b = 5u * gl_WorkGroupID.x;
  uvec3 at = uvec3(block[b], block[b + 1u], block[b + 2u]) + gl_LocalInvocationID;
  uint first = block[b + 3u], count = block[b + 4u];
  if (any(greaterThanEqual(at, size))) return;
  vec3 x = origin + vec3(at) * spacing;
  uint sample_at = at.x + size.x * (at.y + size.y * (at.z - slab));
  float best = least[sample_at];
  uint owner = nearest[sample_at];
  for (uint n = first; n < first + count; ++n) {
    uint t = 10u * place[n];
    vec4 base = texel[t], unit = texel[t + 1u];
    vec3 d = x - base.xyz;
    bool is_in = true;
    for (uint k = 0u; k < uint(unit.w); ++k) {
      vec4 c = texel[t + 2u + k];
      is_in = is_in && dot(c.xyz, d) <= c.w;
    }
    float along = dot(unit.xyz, d);
    vec3 off = base.w == 1.0 ? d - along * unit.xyz : d;
    float squared = base.w == 2.0 ? along * along : dot(off, off);
    if (is_in && squared < best) {
      best = squared;
      owner = place[n];
    }
  }
  nearest[sample_at] = owner;
  least[sample_at] = best;
})";

constexpr float kFar = 3.0e38F;
/// Sites that one invocation looks at: llvmpipe leaves all loops of a shader after 65,535 rounds in
/// sum, without a word, and a site costs one and one for each of its conditions.
constexpr std::uint32_t kMostPlaces = 65'535 / 2 / (1 + kMostConditions);

class Buffers {
 public:
  explicit Buffers(const GladGLContext& gl) : gl_(gl) { gl_.GenBuffers(5, names_); }
  ~Buffers() { gl_.DeleteBuffers(5, names_); }
  Buffers(const Buffers&) = delete;
  Buffers& operator=(const Buffers&) = delete;

  template <class T>
  void fill(GLuint binding, const std::vector<T>& data) {
    gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, names_[binding]);
    gl_.BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(sizeof(T) * data.size()),
                   data.data(), GL_STREAM_DRAW);
  }
  void read(GLuint binding, std::vector<std::uint32_t>& data) {
    gl_.BindBuffer(GL_SHADER_STORAGE_BUFFER, names_[binding]);
    gl_.GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(4 * data.size()),
                         data.data());
  }

 private:
  const GladGLContext& gl_;
  GLuint names_[5] = {0, 0, 0, 0, 0};
};

/// A slab's blocks of 8 x 8 x 8 samples: where each begins, and its part of the lists.
struct Work {
  std::vector<std::uint32_t> lists, blocks;
};

Work work_of(std::span<const CullTile> tiles, const GlJob& job) {
  Work work;
  for (const CullTile& tile : tiles) {
    const auto offset = static_cast<std::uint32_t>(work.lists.size());
    work.lists.insert(work.lists.end(), tile.places.begin(), tile.places.end());
    const CullNode& n = tile.node;
    for (std::uint32_t j = n.begin[1]; j < n.end[1]; j += kBlock) {
      for (std::uint32_t i = n.begin[0]; i < n.end[0]; i += kBlock) {
        work.blocks.insert(work.blocks.end(), {i, j, n.begin[2], offset,
                                               static_cast<std::uint32_t>(tile.places.size())});
        ++job.statistics.blocks;
        job.statistics.block_sites += tile.places.size();
      }
    }
    std::uint64_t samples = 1;
    for (int axis = 0; axis < 3; ++axis) samples *= n.end[axis] - n.begin[axis];
    job.statistics.fragments += samples * tile.places.size();
  }
  // Buffers of no size cannot be bound.
  if (work.lists.empty()) work.lists.push_back(0);
  return work;
}

/// The blocks with more places than have been looked at, with the next of these.
std::vector<std::uint32_t> after(std::span<const std::uint32_t> blocks, std::uint32_t passed) {
  std::vector<std::uint32_t> rest;
  for (; !blocks.empty(); blocks = blocks.subspan(5))
    if (blocks[4] > passed)
      rest.insert(rest.end(), {blocks[0], blocks[1], blocks[2], blocks[3] + passed,
                               std::min(blocks[4] - passed, kMostPlaces)});
  return rest;
}

}  // namespace

bool gather(GlContext& context, GlJob& job, std::string& problem, const UseProposals& use) {
  const GladGLContext& gl = context.gl();
  if (!context.is_at_least(4, 3)) {
    problem = "gather needs OpenGL 4.3, the driver (" + context.driver().renderer + ") has " +
              context.driver().version;
    return false;
  }
  const GLuint program = link_program(gl, kGather, nullptr, problem);
  if (program == 0) return false;
  const VoxelGrid& grid = job.grid;
  const GlFrame& frame = job.frame;
  const std::vector<float> texels = site_texels(job.sites, frame, true);
  GLint most_bytes = 0, most_groups = 0;
  gl.GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most_bytes);
  gl.GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &most_groups);
  if (4 * texels.size() > static_cast<std::size_t>(most_bytes)) {
    problem = "too many sites for the driver: at most " + std::to_string(most_bytes / 160);
    return false;
  }
  gl.UseProgram(program);
  const auto place = [&](const char* name) { return gl.GetUniformLocation(program, name); };
  gl.Uniform3ui(place("size"), grid.size[0], grid.size[1], grid.size[2]);
  const auto scaled_to = [&](int axis) {
    return static_cast<float>(frame.scale * (grid.origin[axis] - frame.centre[axis]));
  };
  const auto step = [&](int axis) { return static_cast<float>(frame.scale * grid.spacing[axis]); };
  gl.Uniform3f(place("origin"), scaled_to(0), scaled_to(1), scaled_to(2));
  gl.Uniform3f(place("spacing"), step(0), step(1), step(2));

  const std::vector<CullTile> tiles = make_cull_tiles(job, kBlock);
  std::vector<std::uint32_t> ids(grid.voxels(), kNoSite.value);
  Buffers buffers(gl);
  buffers.fill(0, texels);
  bool goes_on = true;
  for (std::size_t first = 0; first < tiles.size() && goes_on;) {
    const std::uint32_t slab = tiles[first].node.begin[2];
    std::size_t last = first;
    while (last < tiles.size() && tiles[last].node.begin[2] == slab) ++last;
    const Work work = work_of(std::span(tiles).subspan(first, last - first), job);
    const std::uint32_t slices = tiles[first].node.end[2] - slab;
    std::vector<std::uint32_t> nearest(std::size_t{grid.size[0]} * grid.size[1] * slices,
                                       kNoSite.value);
    if (4 * std::max(work.lists.size(), nearest.size()) > static_cast<std::size_t>(most_bytes)) {
      problem = "the grid is too large for the driver's buffers of " +
                std::to_string(most_bytes >> 20) + " MiB";
      break;
    }
    buffers.fill(1, work.lists);
    buffers.fill(3, nearest);
    buffers.fill(4, std::vector<float>(nearest.size(), kFar));
    gl.Uniform1ui(place("slab"), slab);
    const std::size_t blocks = work.blocks.size() / 5;
    for (std::uint32_t passed = 0;; passed += kMostPlaces) {
      const std::vector<std::uint32_t> rest = after(work.blocks, passed);
      if (rest.empty()) break;
      for (std::size_t b = 0; b < rest.size();) {
        const std::size_t n =
            std::min((rest.size() - b) / 5, static_cast<std::size_t>(most_groups));
        buffers.fill(
            2, std::vector<std::uint32_t>(rest.begin() + static_cast<std::ptrdiff_t>(b),
                                          rest.begin() + static_cast<std::ptrdiff_t>(b + 5 * n)));
        gl.DispatchCompute(static_cast<GLuint>(n), 1, 1);
        b += 5 * n;
      }
      gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    buffers.read(3, nearest);
    for (std::size_t v = 0; v < nearest.size(); ++v) {
      const std::uint32_t n = nearest[v];
      ids[grid.index(0, 0, slab) + v] =
          n < job.sites.site.size() ? job.sites.site[n].id : kNoSite.value;
    }
    for (std::size_t b = 0; b < blocks; ++b) {
      std::array<std::uint32_t, 3> begin{}, end{};
      for (int axis = 0; axis < 3; ++axis) {
        begin[axis] = work.blocks[5 * b + static_cast<std::size_t>(axis)];
        end[axis] = std::min(begin[axis] + std::uint32_t{kBlock}, grid.size[axis]);
      }
      job.statistics.owner_sites += count_owners(ids, grid, begin, end);
    }
    first = last;
    goes_on = job.goes_on(0.9 * static_cast<double>(last) / static_cast<double>(tiles.size()));
  }
  gl.DeleteProgram(program);
  if (problem.empty() && gl.GetError() != GL_NO_ERROR) {
    problem = "the OpenGL driver reports an error";
  }
  if (!problem.empty() || !goes_on) return false;
  use(ids);
  return job.goes_on(1);
}

}  // namespace blum::detail
