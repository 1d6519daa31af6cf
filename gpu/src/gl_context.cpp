#include "gl_context.hpp"

#include <array>
#include <string_view>

namespace blum {

Result<FieldDriver> field_driver(FieldBackend backend) {
  auto context = detail::GlContext::make(backend);
  if (!context) return context.error();
  return context.value()->driver();
}

BackendChoice choose_backend() {
  if (!detail::egl_may_have_hardware()) {
    return {FieldBackend::kCpu, "no graphics hardware for EGL"};
  }
  const Result<FieldDriver> driver = field_driver(FieldBackend::kEgl);
  if (!driver) return {FieldBackend::kCpu, driver.error().message};
  if (!driver.value().is_hardware) {
    return {FieldBackend::kCpu, "no graphics hardware, only " + driver.value().renderer};
  }
  return {FieldBackend::kEgl, driver.value().renderer};
}

}  // namespace blum

namespace blum::detail {

Result<std::unique_ptr<GlContext>> GlContext::make(FieldBackend backend) {
  switch (backend) {
    case FieldBackend::kEgl:
      return make_egl_context();
    case FieldBackend::kOsmesa:
      return make_osmesa_context();
    default:
      return Error{ErrorCode::kBadArgument,
                   std::string(field_backend_name(backend)) + " has no OpenGL driver",
                   {},
                   {}};
  }
}

bool GlContext::learn(GLADapiproc (*find)(const char*)) {
  const int version = gladLoadGLContext(&gl_, find);
  if (version == 0) return false;
  const auto text = [this](GLenum name) {
    const auto* t = reinterpret_cast<const char*>(gl_.GetString(name));
    return std::string(t == nullptr ? "" : t);
  };
  driver_.renderer = text(GL_RENDERER);
  driver_.version = text(GL_VERSION);
  gl_.GetIntegerv(GL_MAJOR_VERSION, &driver_.major);
  gl_.GetIntegerv(GL_MINOR_VERSION, &driver_.minor);
  // What Mesa and others call their renderers without hardware.
  constexpr std::array<std::string_view, 4> kSoftware = {"llvmpipe", "softpipe", "swrast",
                                                         "SwiftShader"};
  driver_.is_hardware = true;
  for (const std::string_view name : kSoftware) {
    if (driver_.renderer.find(name) != std::string::npos) driver_.is_hardware = false;
  }
  return is_at_least(3, 3);
}

}  // namespace blum::detail
