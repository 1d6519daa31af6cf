// Contexts from libEGL: a device's, or the surfaceless platform's.
#include <dlfcn.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "gl_context.hpp"

namespace blum::detail {
namespace {

// From the EGL 1.5 specification and its registry of extensions.
using Display = void*;
using Device = void*;
using Config = void*;
using Handle = void*;
using Int = std::int32_t;
constexpr Int kNone = 0x3038, kSurfaceType = 0x3033, kPbufferBit = 1, kRenderableType = 0x3040,
              kOpenglBit = 8, kExtensions = 0x3055, kMajorVersion = 0x3098, kMinorVersion = 0x30FB,
              kProfileMask = 0x30FD, kCoreProfile = 1;
constexpr unsigned kOpenglApi = 0x30A2, kPlatformDevice = 0x313F, kPlatformSurfaceless = 0x31DD;

struct Egl {
  GLADapiproc (*get_proc_address)(const char*) = nullptr;
  unsigned (*initialize)(Display, Int*, Int*) = nullptr;
  unsigned (*bind_api)(unsigned) = nullptr;
  unsigned (*choose_config)(Display, const Int*, Config*, Int, Int*) = nullptr;
  Handle (*create_context)(Display, Config, Handle, const Int*) = nullptr;
  unsigned (*destroy_context)(Display, Handle) = nullptr;
  unsigned (*make_current)(Display, Handle, Handle, Handle) = nullptr;
  unsigned (*release_thread)() = nullptr;
  unsigned (*query_devices)(Int, Device*, Int*) = nullptr;
  const char* (*query_device_string)(Device, Int) = nullptr;
  Display (*get_platform_display)(unsigned, void*, const Int*) = nullptr;
  std::string problem;  // empty: usable
};

Egl load_egl() {
  Egl egl;
  void* library = dlopen("libEGL.so.1", RTLD_LOCAL | RTLD_NOW);
  if (library == nullptr) {
    egl.problem = "no libEGL.so.1 (Debian: libegl1, and libgl1-mesa-dri or a vendor's driver)";
    return egl;
  }
  const auto find = [library](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
    return function != nullptr;
  };
  const bool has_core =
      find(egl.get_proc_address, "eglGetProcAddress") && find(egl.initialize, "eglInitialize") &&
      find(egl.bind_api, "eglBindAPI") && find(egl.choose_config, "eglChooseConfig") &&
      find(egl.create_context, "eglCreateContext") &&
      find(egl.destroy_context, "eglDestroyContext") && find(egl.make_current, "eglMakeCurrent") &&
      find(egl.release_thread, "eglReleaseThread");
  if (!has_core) {
    egl.problem = "libEGL.so.1 lacks functions of EGL 1.4";
    return egl;
  }
  const auto extension = [&egl](auto& function, const char* name) {
    function =
        reinterpret_cast<std::remove_reference_t<decltype(function)>>(egl.get_proc_address(name));
  };
  extension(egl.query_devices, "eglQueryDevicesEXT");
  extension(egl.query_device_string, "eglQueryDeviceStringEXT");
  extension(egl.get_platform_display, "eglGetPlatformDisplayEXT");
  if (egl.get_platform_display == nullptr) {
    egl.problem = "EGL without EXT_platform_base";
  }
  return egl;
}

const Egl& egl() {
  static const Egl functions = load_egl();
  return functions;
}

class EglContext : public GlContext {
 public:
  explicit EglContext(Display display) : display_(display) {}
  ~EglContext() override {
    if (context_ != nullptr) egl().destroy_context(display_, context_);
  }

  /// False if the display has no such contexts.
  bool open() {
    if (egl().bind_api(kOpenglApi) == 0) return false;
    const std::array<Int, 5> wanted = {kSurfaceType, kPbufferBit, kRenderableType, kOpenglBit,
                                       kNone};
    Config config = nullptr;  // none is allowed where EGL_KHR_no_config_context is
    Int count = 0;
    if (egl().choose_config(display_, wanted.data(), &config, 1, &count) == 0 || count == 0) {
      config = nullptr;
    }
    for (const auto& [major, minor] : {std::pair{4, 5}, {4, 3}, {3, 3}}) {
      const std::array<Int, 7> version = {kMajorVersion, major,        kMinorVersion, minor,
                                          kProfileMask,  kCoreProfile, kNone};
      context_ = egl().create_context(display_, config, nullptr, version.data());
      if (context_ != nullptr) break;
    }
    if (context_ == nullptr) return false;
    const Current current(*this);
    return current && learn(egl().get_proc_address);
  }

 protected:
  bool bind() override {
    return egl().bind_api(kOpenglApi) != 0 &&
           egl().make_current(display_, nullptr, nullptr, context_) != 0;
  }
  void unbind() override {
    egl().make_current(display_, nullptr, nullptr, nullptr);
    egl().release_thread();
  }

 private:
  Display display_;
  Handle context_ = nullptr;
};

struct Devices {
  bool are_known = false;
  std::vector<Device> hardware, software;
};

Devices find_devices() {
  Devices found;
  if (!egl().problem.empty() || egl().query_devices == nullptr ||
      egl().query_device_string == nullptr) {
    return found;
  }
  std::array<Device, 32> devices{};
  Int count = 0;
  if (egl().query_devices(static_cast<Int>(devices.size()), devices.data(), &count) == 0) {
    return found;
  }
  found.are_known = true;
  for (Int k = 0; k < count; ++k) {
    const char* extensions = egl().query_device_string(devices[k], kExtensions);
    const bool is_software =
        extensions != nullptr && std::strstr(extensions, "EGL_MESA_device_software") != nullptr;
    (is_software ? found.software : found.hardware).push_back(devices[k]);
  }
  return found;
}

const Devices& devices() {
  static const Devices found = find_devices();
  return found;
}

/// Initialized once and for good: terminating a display would end all of its contexts.
std::vector<Display> open_displays() {
  std::vector<Display> out;
  const auto add = [&out](unsigned platform, void* device) {
    Display display = egl().get_platform_display(platform, device, nullptr);
    if (display != nullptr && egl().initialize(display, nullptr, nullptr) != 0) {
      out.push_back(display);
    }
  };
  for (Device device : devices().hardware) add(kPlatformDevice, device);
  for (Device device : devices().software) add(kPlatformDevice, device);
  add(kPlatformSurfaceless, nullptr);
  return out;
}

}  // namespace

bool egl_may_have_hardware() {
  return egl().problem.empty() && (!devices().are_known || !devices().hardware.empty());
}

Result<std::unique_ptr<GlContext>> make_egl_context() {
  const auto problem = [](const std::string& what) {
    return Error{ErrorCode::kBadArgument, "no OpenGL through EGL: " + what, {}, {}};
  };
  if (!egl().problem.empty()) return problem(egl().problem);
  static const std::vector<Display> all = open_displays();
  for (Display display : all) {
    auto context = std::make_unique<EglContext>(display);
    if (context->open()) return std::unique_ptr<GlContext>(std::move(context));
  }
  return problem("no driver with OpenGL 3.3 (Debian: libgl1-mesa-dri)");
}

}  // namespace blum::detail
