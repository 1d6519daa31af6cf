// Contexts from libOSMesa: Mesa's renderers without hardware, drawing into memory.
#include <dlfcn.h>

#include <array>
#include <utility>

#include "gl_context.hpp"

namespace blum::detail {
namespace {

// From Mesa's GL/osmesa.h.
constexpr int kFormat = 0x22, kDepthBits = 0x30, kProfile = 0x33, kCoreProfile = 0x34,
              kMajorVersion = 0x36, kMinorVersion = 0x37;

struct Osmesa {
  void* (*create)(const int*, void*) = nullptr;
  void (*destroy)(void*) = nullptr;
  GLboolean (*make_current)(void*, void*, GLenum, GLsizei, GLsizei) = nullptr;
  GLADapiproc (*get_proc_address)(const char*) = nullptr;
  std::string problem;  // empty: usable
};

Osmesa load_osmesa() {
  Osmesa mesa;
  void* library = nullptr;
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}) {
    library = dlopen(name, RTLD_LOCAL | RTLD_NOW);
    if (library != nullptr) break;
  }
  if (library == nullptr) {
    mesa.problem = "no libOSMesa.so.8 (Debian: libosmesa6)";
    return mesa;
  }
  const auto find = [library](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
    return function != nullptr;
  };
  if (!find(mesa.create, "OSMesaCreateContextAttribs") ||
      !find(mesa.destroy, "OSMesaDestroyContext") ||
      !find(mesa.make_current, "OSMesaMakeCurrent") ||
      !find(mesa.get_proc_address, "OSMesaGetProcAddress")) {
    mesa.problem = "libOSMesa is older than Mesa 12";
  }
  return mesa;
}

const Osmesa& osmesa() {
  static const Osmesa functions = load_osmesa();
  return functions;
}

class OsmesaContext : public GlContext {
 public:
  ~OsmesaContext() override {
    if (context_ != nullptr) osmesa().destroy(context_);
  }

  bool open() {
    for (const auto& [major, minor] : {std::pair{4, 5}, {4, 3}, {3, 3}}) {
      const std::array<int, 11> wanted = {
          kFormat,       GL_RGBA, kDepthBits,    0,     kProfile, kCoreProfile,
          kMajorVersion, major,   kMinorVersion, minor, 0};
      context_ = osmesa().create(wanted.data(), nullptr);
      if (context_ == nullptr) continue;
      {
        const Current current(*this);
        if (current && learn(osmesa().get_proc_address)) return true;
      }
      osmesa().destroy(std::exchange(context_, nullptr));
    }
    return false;
  }

 protected:
  bool bind() override {
    return osmesa().make_current(context_, image_.data(), GL_UNSIGNED_BYTE, kSide, kSide) != 0;
  }
  void unbind() override { osmesa().make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

 private:
  static constexpr GLsizei kSide = 4;  // of an image that nothing is drawn into
  std::array<unsigned char, 4 * kSide * kSide> image_{};
  void* context_ = nullptr;
};

}  // namespace

Result<std::unique_ptr<GlContext>> make_osmesa_context() {
  const auto problem = [](const std::string& what) {
    return Error{ErrorCode::kBadArgument, "no OpenGL through OSMesa: " + what, {}, {}};
  };
  if (!osmesa().problem.empty()) return problem(osmesa().problem);
  auto context = std::make_unique<OsmesaContext>();
  if (!context->open()) return problem("no driver with OpenGL 3.3");
  return std::unique_ptr<GlContext>(std::move(context));
}

}  // namespace blum::detail
