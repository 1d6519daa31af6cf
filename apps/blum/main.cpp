// The `blum` command line: parses, calls the library, prints. All the mathematics is elsewhere.
#include <exception>
#include <iostream>
#include <new>

#include "commands.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"

namespace blum::app {
namespace {

constexpr const char* kFooter = R"(Examples:
  blum make plate 2 6 -o plate.off        a plate with two hexagonal holes
  blum info plate.off                     is it a solid? what kind of?
  blum medial plate.off -o out/plate      out/plate.ma, .vtp, .obj: the medial axis
  blum medial plate.off --resolve --summary plate.json
  blum field plate.off --resolution 128 --signed -o plate.vti
  blum medial plate.off --certificate plate.cert
  blum verify plate.off plate.cert        check it, independently
  blum certificate plate.cert             say what it says
  blum medial plate.off --angles && blum view plate -o plate.html    look at it in a browser
  blum render plate -o plate.png          or as a picture
  blum thickness plate.off                how thick are the walls? where are they thinnest?

Exit codes: 0 done (medial: certified), 1 usage, 2 input, 3 not certified or --epsilon not reached
(files are written), 4 false (verify), 5 output could not be written, 70 internal error, 130 and
143 interrupted.)";

int run(int argc, char** argv) {
  CLI::App app("Blum: certified medial axes of polyhedral solids.", "blum");
  app.set_version_flag("--version", "blum " BLUM_VERSION);
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.footer(kFooter);
  app.require_subcommand(1);
  const Command info = add_info_command(app), make = add_make_command(app),
                medial = add_medial_command(app), field = add_field_command(app),
                voronoi = add_voronoi_command(app), verify = add_verify_command(app),
                certificate = add_certificate_command(app), thickness = add_thickness_command(app),
                midsurface = add_midsurface_command(app), view = add_view_command(app),
                render = add_render_command(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kUsage;
  }
  catch_signals();
  if (app.got_subcommand("info")) return info();
  if (app.got_subcommand("make")) return make();
  if (app.got_subcommand("field")) return field();
  if (app.got_subcommand("voronoi")) return voronoi();
  if (app.got_subcommand("verify")) return verify();
  if (app.got_subcommand("certificate")) return certificate();
  if (app.got_subcommand("thickness")) return thickness();
  if (app.got_subcommand("midsurface")) return midsurface();
  if (app.got_subcommand("view")) return view();
  if (app.got_subcommand("render")) return render();
  return medial();
}

/// Output that did not reach stdout (a full disk, say) is output not written.
int with_stdout_flushed(int code) {
  std::cout.flush();
  if (std::cout || (code != kSuccess && code != kNotCertified)) return code;
  std::cerr << "blum: error: output_not_written: standard output\n";
  return kOutput;
}

}  // namespace
}  // namespace blum::app

int main(int argc, char** argv) {
  try {
    return blum::app::with_stdout_flushed(blum::app::run(argc, argv));
  } catch (const std::bad_alloc&) {
    std::cerr << "blum: error: out_of_memory\n";
  } catch (const std::exception& error) {
    std::cerr << "blum: error: internal: " << error.what()
              << "\nThis is a defect of blum, not of its input; please report it with the model.\n";
  }
  return blum::app::kInternal;
}
