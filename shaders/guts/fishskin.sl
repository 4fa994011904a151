/* fishskin.sl: skin of a thin fish that shows what is inside, when light comes from behind most of all.
 *
 * In two passes: the innards alone, with constant shaders, red for organs and green for the skeleton, from the viewing camera, into gutmap;
 * then the fish with this shader. The fish lies with x across (its thin side), y up and z along in shader space.
 */
#include "gutmap.h"

surface
fishskin(uniform string gutmap = "";      /* of this frame; "" for none */
         uniform float mipmapped = 0;      /* 1: let large blurs use the levels of a mip-map */
         uniform float gutblur = 0.25;     /* how far organs are diffused, shader space; more than the skeleton */
         uniform float skelblur = 0.08;    /* the same of the skeleton */
         uniform float core = 0.4;         /* blur of the dark core, as a part of those */
         uniform float thin = 0.6;         /* part of the blur when the fish is seen edge on */
         uniform color gutcolor = color (0.45, 0.3, 0.12); /* of the halo of organs */
         uniform color skelcolor = color (0.75, 0.6, 0.35); /* of that of the skeleton */
         uniform float gutshow = 0.8, skelshow = 0.6; /* how much of the halo shows, 0 to 1 */
         uniform float gutdark = 0.8, skeldark = 0.7; /* how much the cores keep light from coming through */
         varying float inside = 1;         /* primitive variable: 0 on fins, in front of which nothing is inside */
         uniform color skincolor = color (1, 0.82, 0.1); /* times Cs */
         uniform float Ka = 1, Kd = 0.7, Ks = 0.4, roughness = 0.12; /* parts of ambient, diffuse, specular light; highlight width */
         uniform float Kback = 0.8;        /* light that comes through from behind */
         output varying float organs = 0;  /* what was seen, for passes and tests */
         output varying float skeleton = 0; /* both 0 to 1 */
         )
{
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);
  color Cskin = skincolor * Cs;
  float through = 1;

  if (gutmap != "" && (gutshow > 0 || skelshow > 0 || gutdark > 0 || skeldark > 0)) {
    if (inside > 0) {
      float ss, tt;
      gutplace(P, ss, tt);
      float wide = thinblur(gutblur(P, gutblur), thin), narrow = thinblur(gutblur(P, skelblur), thin);
      organs = inside * gutmap(gutmap, 0, ss, tt, wide, mipmapped);
      skeleton = inside * gutmap(gutmap, 1, ss, tt, narrow, mipmapped);
      Cskin = mix(Cskin, gutcolor * Cs, gutshow * organs);
      Cskin = mix(Cskin, skelcolor * Cs, skelshow * skeleton);
      if (Kback > 0 && (gutdark > 0 || skeldark > 0)) {
        float organcore = inside * gutmap(gutmap, 0, ss, tt, core * wide, mipmapped);
        float skelcore = inside * gutmap(gutmap, 1, ss, tt, core * narrow, mipmapped);
        through = (1 - gutdark * organcore) * (1 - skeldark * skelcore);
      }
    }
  }

  color Cback = 0;
  if (Kback > 0)
    Cback = Kback * through * diffuse(-Nf);
  Oi = Os;
  Ci = Os * (Cskin * (Ka * ambient() + Kd * diffuse(Nf) + Cback) + Ks * specular(Nf, V, roughness));
}
