// Types of parameters that render/rib/parameters.def does not know one by one.
#include "render/ri/further_parameters.h"

namespace render::ri {

namespace {

constexpr FurtherParameter kParameters[] = {
    {"Option rib", "precision", "integer"},
    {"Option hider", "jitter", "integer"},
    {"Option hider", "depthfilter", "string"},
    {"Attribute identifier", "shadinggroup", "string"},
    {"Attribute visibility", "transmission", "string"},
    {"Attribute shade", "camerahitmode", "string"},
    {"Attribute shade", "strategy", "string"},
    {"Attribute shade", "volumeintersectionstrategy", "string"},
    {"Attribute shade", "volumeintersectionpriority", "float"},
    {"Attribute shade", "relativeshadingrate", "float"},
    {"Attribute photon", "globalmap", "string"},
    {"Attribute photon", "causticmap", "string"},
    {"Attribute photon", "shadingmodel", "string"},
    {"Attribute photon", "estimator", "integer"},
    {"Attribute photon", "maxdiffusedepth", "integer"},
    {"Attribute photon", "maxspeculardepth", "integer"},
    {"Attribute photon", "minstoredepth", "integer"},
    {"Attribute stochastic", "sigma", "integer"},
    {"Attribute stochastic", "pointfalloff", "integer"},
    {"Hider", "emit", "integer"},
    {"ArchiveBegin", "Content-Type", "string"},
    {"ArchiveBegin", "Content-Transfer-Encoding", "string"},
};

} // namespace

std::span<const FurtherParameter> further_parameters() {
  return kParameters;
}

} // namespace render::ri
