/* coral.sl: one shader for all corals, in three layers: bare bone, velvet skin and polyps, each with a light of its own, and a glow
 * from within that a light behind the model gives, without any tracing.
 *
 * Use with coraldisplacement.sl of the same parameters: it makes polyps and says where they and the bone are. Without it the coral is all
 * velvet. Layers meet in narrow edges, so that at most places the code of one of them runs. A weight of 0 switches its part off: the
 * condition is uniform, nothing of the part runs.
 */
#include "coral.h"

surface
coral(uniform float id = 0;              /* number of the model, for variation; 0: none */
      uniform float size = 1;            /* of pattern features, shader space */
      uniform float sizevariation = 0.3; /* how much size differs between models: by up to half of this part of it */
      uniform float huevariation = 0.06; /* of all colours: part of the circle */
      uniform float saturationvariation = 0.15, valuevariation = 0.15; /* by up to such parts of themselves, 0 to 1 */
      varying float tipdistance = 1;     /* scalar fields, primitive variables */
      varying float basedistance = 1;    /* 0 at the base, 1 farthest from it; used by the displacement */
      uniform float Ka = 1;              /* part of ambient light, all layers */
      /* Bone. */
      uniform color bonecolor = color (0.85, 0.8, 0.7); /* on its ridges */
      uniform color bonestain = color (0.5, 0.42, 0.3); /* in its hollows */
      uniform float bonepattern = 24, bonecontrast = 0.7; /* number of its pattern (organicpatterns.h); how much it shows, 0 to 1 */
      /* Velvet. */
      uniform color velvetcolor = color (0.75, 0.25, 0.3); /* away from the tips */
      uniform color velvettip = color (0.95, 0.75, 0.7);   /* towards the tips */
      uniform float tiplength = 0.25;                      /* tipdistance at which it begins; 0: none */
      uniform float velvetpattern = 1, velvetcontrast = 0.4; /* number of its pattern; how much it darkens, 0 to 1 */
      uniform string velvetmap = "";                         /* one channel, for patterns 32 to 35 */
      uniform float Kvelvet = 0.9;                           /* part of diffuse light */
      uniform float sheen = 0.5, sheenexponent = 4;        /* the pale edge of velvet */
      /* Polyps. */
      uniform color polypcolor = color (0.95, 0.8, 0.45);  /* of polyps */
      uniform float Kpolyp = 1, polypspecular = 0.35, polyproughness = 0.08; /* parts of light (0: no polyps), highlight width */
      uniform float polypedge = 0.25;                      /* height at which a polyp begins */
      /* Light from within. */
      uniform float Kscatter = 0;                          /* 0: none */
      uniform color scatterinner = color (1, 0.35, 0.2), scatterouter = color (0.55, 0.2, 0.2); /* at rims and tips; facing the viewer */
      uniform color scattertexcolor = color (0.25, 0.08, 0.1);                                  /* where it is dense */
      uniform float scatterdensity = 0.5;                  /* influence of the pattern of density */
      uniform float densitypattern = 2, densitysize = 2;   /* features as many times as large */
      uniform float scatterforward = 0.8;                  /* 1: only lights behind it; 0: all lights alike */
      uniform float shadowdensity = 0.7;                   /* how dark shadows are in it */
      )
{
  normal Nn = faceforward(normalize(N), I);
  vector V = -normalize(I);
  vector variation = modelvariation(id);
  float normaldot = facing(Nn, I), polyp = 0, bone = 0, noisevalue = -1;
  point surfacepoint = P;
  displacement("normaldot", normaldot);
  displacement("polyp", polyp);
  displacement("bone", bone);
  displacement("noisevalue", noisevalue);
  displacement("undisplaced", surfacepoint);

  /* Patterns lie on the surface as it was before displacement. */
  point Pq = variedspace(transform("shader", surfacepoint), variation, size, sizevariation);
  float width = filterwidthp(Pq);
  color Clayer = 0, Cglow = 0;

  if (Kscatter > 0) {
    float density = 0;
    if (scatterdensity > 0)
      density = scatterdensity * organicpattern(densitypattern, Pq / densitysize, width / densitysize, "", 0, 0);
    color inner = variedcolor(scatterinner, variation, huevariation, saturationvariation, valuevariation);
    color outer = variedcolor(scatterouter, variation, huevariation, saturationvariation, valuevariation);
    color texcolor = variedcolor(scattertexcolor, variation, huevariation, saturationvariation, valuevariation);
    Cglow = Kscatter * scattercolor(inner, outer, texcolor, tipdistance, normaldot, density) *
            scatterillum(P, I, scatterforward, shadowdensity);
  }

  if (bone < 1) {
    float onpolyp = smoothstep(polypedge, polypedge + 0.15, polyp);
    if (Kpolyp == 0)
      onpolyp = 0;
    if (onpolyp < 1) {
      color C = variedcolor(velvetcolor, variation, huevariation, saturationvariation, valuevariation);
      if (velvetcontrast > 0) {
        float ss = 0, tt = 0;
        if (velvetpattern >= 11)
          cubicprojection(Pq, ntransform("shader", Nn), ss, tt);
        float pattern = noisevalue; /* what the displacement made is good enough for noise here */
        if (velvetpattern != 1 || noisevalue < 0)
          pattern = organicpattern(velvetpattern, Pq, width, velvetmap, ss, tt);
        C *= 1 - velvetcontrast * (1 - pattern);
      }
      if (tiplength > 0)
        C = mix(velvettip, C, smoothstep(0, tiplength, tipdistance));
      color velvet = C * (Ka * ambient() + Kvelvet * diffuse(Nn));
      if (sheen > 0)
        velvet += sheen * pow(1 - min(Nn . V, 1), sheenexponent) * C * diffuse(Nn);
      Clayer = velvet;
    }
    if (Kpolyp > 0 && onpolyp > 0) {
      color C = variedcolor(polypcolor, variation, huevariation, saturationvariation, valuevariation);
      color wet = C * (Ka * ambient() + Kpolyp * diffuse(Nn));
      if (polypspecular > 0)
        wet += polypspecular * specular(Nn, V, polyproughness);
      Clayer = mix(Clayer, wet, onpolyp);
    }
    Clayer += Cglow;
  }
  if (bone > 0) {
    color C = bonecolor;
    if (bonecontrast > 0)
      C = mix(bonecolor, bonestain, bonecontrast * organicpattern(bonepattern, 2 * Pq, 2 * width, "", 0, 0));
    Clayer = mix(Clayer, C * (Ka * ambient() + diffuse(Nn)), bone);
  }
  Oi = Os;
  Ci = Os * Cs * Clayer;
}
