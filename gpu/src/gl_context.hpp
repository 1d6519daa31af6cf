/// OpenGL without a window, a display server or a linked library.
///
/// libEGL and libOSMesa are loaded when a context is first asked for, each with names of its own
/// (RTLD_LOCAL: together in one name space they clash), and stay loaded: drivers do not survive
/// being unloaded. OpenGL's functions are found by the loader that glad 2 generated (gpu/glad); the
/// dozen of EGL and OSMesa are looked up by name, since glad's table of EGL functions is global,
/// and must not be shared by what two libraries return.
#pragma once

#include <glad/gl.h>

#include <memory>
#include <string>

#include "blum/gpu/field.hpp"
#include "blum/kernel/result.hpp"

namespace blum::detail {

class GlContext {
 public:
  /// The newest core profile there is, at least 3.3. `backend`: kEgl (hardware devices first, then
  /// others, then the surfaceless platform) or kOsmesa. Any number of contexts may exist at once.
  /// Errors (kBadArgument): no library, no driver; the message says which package brings it.
  [[nodiscard]] static Result<std::unique_ptr<GlContext>> make(FieldBackend backend);
  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Of this context; to be called while it is current.
  [[nodiscard]] const GladGLContext& gl() const { return gl_; }
  [[nodiscard]] const FieldDriver& driver() const { return driver_; }
  [[nodiscard]] bool is_at_least(int major, int minor) const {
    return driver_.major > major || (driver_.major == major && driver_.minor >= minor);
  }

  /// Makes the context the calling thread's until the end of the scope. A thread has one at a time,
  /// a context one thread.
  class Current {
   public:
    explicit Current(GlContext& context) : context_(context), is_current_(context.bind()) {}
    ~Current() {
      if (is_current_) context_.unbind();
    }
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
    explicit operator bool() const { return is_current_; }

   private:
    GlContext& context_;
    bool is_current_;
  };

 protected:
  GlContext() = default;
  [[nodiscard]] virtual bool bind() = 0;
  virtual void unbind() = 0;
  /// Loads the functions and asks the driver who it is; false if it is too old.
  [[nodiscard]] bool learn(GLADapiproc (*find)(const char*));

 private:
  GladGLContext gl_{};
  FieldDriver driver_;
};

[[nodiscard]] Result<std::unique_ptr<GlContext>> make_egl_context();
/// False if EGL says that all of its devices are software: quicker than to make a context and see.
[[nodiscard]] bool egl_may_have_hardware();
[[nodiscard]] Result<std::unique_ptr<GlContext>> make_osmesa_context();

}  // namespace blum::detail
