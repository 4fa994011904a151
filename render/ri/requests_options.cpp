// Ri functions: camera, image and other options, and the making of maps.
#include "render/ri/define.h"

using render::ri::Dash;
using render::ri::Filter;
using render::ri::Floats;
using render::ri::LeftOut;
using render::ri::Optional;
using render::ri::Texts;

extern "C" {

RI_PLAIN(Format, (RtInt xres, RtInt yres, RtFloat pixelaspect), xres, yres, pixelaspect)
RI_PLAIN(FrameAspectRatio, (RtFloat aspect), aspect)
RI_PLAIN(ScreenWindow, (RtFloat left, RtFloat right, RtFloat bottom, RtFloat top), left, right, bottom, top)
RI_PLAIN(CropWindow, (RtFloat xmin, RtFloat xmax, RtFloat ymin, RtFloat ymax), xmin, xmax, ymin, ymax)
RI_PARAMETERS(Projection, (RtToken name), name, Optional{name})
RI_PLAIN(Clipping, (RtFloat near_, RtFloat far_), near_, far_)
RI_PLAIN(ClippingPlane, (RtFloat x, RtFloat y, RtFloat z, RtFloat nx, RtFloat ny, RtFloat nz), x, y, z, nx,
         ny, nz)
RI_PLAIN(Shutter, (RtFloat open, RtFloat close), open, close)
RI_PLAIN(PixelVariance, (RtFloat variance), variance)
RI_PLAIN(PixelSamples, (RtFloat x, RtFloat y), x, y)
RI_PLAIN(Exposure, (RtFloat gain, RtFloat gamma), gain, gamma)
RI_PARAMETERS(Imager, (RtToken name), name, name)
RI_PLAIN(Quantize, (RtToken type, RtInt one, RtInt min, RtInt max, RtFloat dither), type, one, min, max,
         dither)
RI_PARAMETERS(Display, (RtToken name, RtToken type, RtToken mode), mode, name, type, mode)
RI_PARAMETERS(DisplayChannel, (RtToken name), name, name)
RI_PARAMETERS(Hider, (RtToken type), type, type)
RI_PLAIN(ColorSamples, (RtInt n, RtFloat nRGB[], RtFloat RGBn[]), Floats{nRGB, n * 3}, Floats{RGBn, n * 3})
RI_PLAIN(RelativeDetail, (RtFloat detail), detail)

RtVoid RiDepthOfField(RtFloat fstop, RtFloat focallength, RtFloat focaldistance) {
  auto* context = render::ri::current("RiDepthOfField");
  if (!context) return;
  if (fstop >= RI_INFINITY)
    context->send(render::RequestId::kDepthOfField, {}, Dash{true}, LeftOut{}, LeftOut{}, LeftOut{});
  else
    context->send(render::RequestId::kDepthOfField, {}, Dash{false}, fstop, focallength, focaldistance);
}

RtVoid RiPixelFilter(RtFilterFunc filter, RtFloat xwidth, RtFloat ywidth) {
  if (auto* context = render::ri::current("RiPixelFilter")) context->pixel_filter(filter, xwidth, ywidth);
}

RtVoid RiOptionV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]) {
  render::ri::ParameterList list{n, tokens, values};
  if (!render::ri::current() && name && std::string_view(name) == "rib")
    render::ri::set_rib_option_outside(list);
  else if (auto* context = render::ri::current("RiOption"))
    context->send(render::RequestId::kOption, list, name);
}

RtVoid RiOption(RtToken name, ...) {
  va_list arguments;
  va_start(arguments, name);
  render::ri::CollectedParameters collected(arguments);
  va_end(arguments);
  render::ri::ParameterList list = collected.list();
  RiOptionV(name, list.count, const_cast<RtToken*>(list.tokens), const_cast<RtPointer*>(list.values));
}

RI_PARAMETERS(MakeTexture,
              (RtToken image, RtToken texture, RtToken swrap, RtToken twrap, RtFilterFunc filter,
               RtFloat swidth, RtFloat twidth),
              twidth, image, texture, swrap, twrap, Filter{filter}, swidth, twidth)
RI_PARAMETERS(MakeBump,
              (RtToken image, RtToken bump, RtToken swrap, RtToken twrap, RtFilterFunc filter, RtFloat swidth,
               RtFloat twidth),
              twidth, image, bump, swrap, twrap, Filter{filter}, swidth, twidth)
RI_PARAMETERS(MakeLatLongEnvironment,
              (RtToken image, RtToken texture, RtFilterFunc filter, RtFloat swidth, RtFloat twidth), twidth,
              image, texture, Filter{filter}, swidth, twidth)
RI_PARAMETERS(MakeCubeFaceEnvironment,
              (RtToken px, RtToken nx, RtToken py, RtToken ny, RtToken pz, RtToken nz, RtToken texture,
               RtFloat fov, RtFilterFunc filter, RtFloat swidth, RtFloat twidth),
              twidth, px, nx, py, ny, pz, nz, texture, fov, Filter{filter}, swidth, twidth)
RI_PARAMETERS(MakeShadow, (RtToken zfile, RtToken shadow), shadow, zfile, shadow)
RI_PARAMETERS(MakeOcclusion, (RtInt nfiles, RtString zfiles[], RtToken shadow), shadow, Texts{zfiles, nfiles},
              shadow)
RI_PARAMETERS(MakeBrickMap, (RtInt nclouds, RtString pointclouds[], RtToken brickmap), brickmap,
              Texts{pointclouds, nclouds}, brickmap)

} // extern "C"
