/* scattering.h: light in scattering media, as formulas for each of three colours: what a medium is made of and what it looks like,
 * the dipole of diffusion, the phase function. The same as the C++ library of stdlib/subsurface, which names the sources; where
 * the papers err, the right form stands here. Coefficients are in the inverse of the unit of positions, eta is the index of
 * refraction, inside over outside.
 *
 * After "Implementing a Skin BSSRDF" (Hery, RenderMan, Theory and Practice, SIGGRAPH 2003 course 9, chapter 4).
 */
#ifndef ANEMONE_SCATTERING_H
#define ANEMONE_SCATTERING_H

/* exp(), component by component. */
color expcolor(color x) {
  return color (exp(comp(x, 0)), exp(comp(x, 1)), exp(comp(x, 2)));
}

/* Of diffuse light from inside, the part that the surface throws back: Fdr, as a fit for eta from 1. */
float diffusefresnel(float eta) {
  return -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta;
}

/* A = (1 + Fdr) / (1 - Fdr). */
float boundarymismatch(float eta) {
  float fdr = diffusefresnel(eta);
  return (1 + fdr) / (1 - fdr);
}

/* The diffuse albedo Rd of a medium with sigma_tr / sigma_t' = sqrt(3 (1 - alpha')) = ratio: from 1 for ratio 0 down to 0 for
 * sqrt(3).
 */
float albedoofratio(float ratio; float mismatch) {
  return 0.5 * (1 - ratio * ratio / 3) * (1 + exp(-4 / 3 * mismatch * ratio)) * exp(-ratio);
}

/* Its inverse, by Newton's steps within a bracket. In this variable the curve is tame; alpha' itself hangs on the root of 1 - Rd, so
 * that tables of it are poor near 1.
 */
float ratioofalbedo(float albedo; float mismatch) {
  float low = 0, high = sqrt(3), s = 0.5, i;
  float k = 4 / 3 * mismatch;
  for (i = 0; i < 10; i += 1) {
    float e = exp(-k * s), f = 1 - s * s / 3;
    float off = 0.5 * f * (1 + e) * exp(-s) - albedo;
    if (off > 0)
      low = s;
    else
      high = s;
    float next = s + off / (0.5 * exp(-s) * (2 * s / 3 * (1 + e) + k * e * f + (1 + e) * f));
    s = next < low || next > high ? 0.5 * (low + high) : next;
  }
  return albedo <= 0 ? sqrt(3) : albedo >= 1 ? 0 : s;
}

/* alpha' of a medium with this diffuse albedo. */
float reducedalbedo(float albedo; float mismatch) {
  float s = ratioofalbedo(albedo, mismatch);
  return 1 - s * s / 3;
}

/* From what is seen, the colour under diffuse light (that of a texture) and the diffuse mean free path 1 / sigma_tr: the coefficients
 * (sigma_s is not reduced). g is the mean cosine of scattering.
 */
void mediumof(color albedo; color freepath; float g; float eta; output color sigma_a; output color sigma_s) {
  float mismatch = boundarymismatch(eta), i;
  for (i = 0; i < 3; i += 1) {
    float ratio = max(ratioofalbedo(comp(albedo, i), mismatch), 1e-4);
    float extinction = 1 / (comp(freepath, i) * ratio);
    float absorption = extinction * ratio * ratio / 3;
    setcomp(sigma_a, i, absorption);
    setcomp(sigma_s, i, (extinction - absorption) / (1 - g));
  }
}

/* The same from the albedo and a fixed sigma_s': the absorption. */
color absorptionof(color albedo; color reducedscattering; float eta) {
  color sigma_a = 0;
  float mismatch = boundarymismatch(eta), i;
  for (i = 0; i < 3; i += 1) {
    float ratio = ratioofalbedo(comp(albedo, i), mismatch);
    float absorbed = ratio * ratio / 3;
    setcomp(sigma_a, i, comp(reducedscattering, i) * absorbed / max(1 - absorbed, 1e-9));
  }
  return sigma_a;
}

/* The dipole: what leaves at distance r of light that enters at a point, a unit of area: Rd(r). */
float dipole(float r; float alpha; float sigma_tr; float zr; float zv) {
  float dr = sqrt(r * r + zr * zr), dv = sqrt(r * r + zv * zv);
  return alpha / (4 * PI) *
         (zr * (1 + sigma_tr * dr) * exp(-sigma_tr * dr) / (dr * dr * dr) +
          zv * (1 + sigma_tr * dv) * exp(-sigma_tr * dv) / (dv * dv * dv));
}

/* Of a medium by its albedo and diffuse mean free path. */
color dipoleof(float r; color albedo; color freepath; float eta) {
  color sum = 0;
  float mismatch = boundarymismatch(eta), i;
  for (i = 0; i < 3; i += 1) {
    float ratio = max(ratioofalbedo(comp(albedo, i), mismatch), 1e-4);
    float zr = comp(freepath, i) * ratio; /* 1 / sigma_t' */
    setcomp(sum, i, dipole(r, 1 - ratio * ratio / 3, 1 / comp(freepath, i), zr, zr * (1 + 4 / 3 * mismatch)));
  }
  return sum;
}

/* Henyey and Greenstein's phase function, 1 over all directions; cosine: between the directions of travel before and after. */
float henyeygreenstein(float cosine; float g) {
  return (1 - g * g) / (4 * PI * pow(1 + g * g - 2 * g * cosine, 1.5));
}

/* The part of light from outside that gets through the surface; cosine: between normal and light. */
float fresneltransmittance(float cosine; float eta) {
  float reflected, through;
  vector R, T;
  float sine = sqrt(max(0, 1 - cosine * cosine));
  fresnel(vector (sine, 0, -cosine), vector (0, 0, 1), 1 / eta, reflected, through, R, T);
  return 1 - reflected;
}

/* The cosine inside the medium of a direction outside. */
float cosineinside(float cosine; float eta) {
  return sqrt(1 - (1 - cosine * cosine) / (eta * eta));
}

/* How long the way in the medium is of a ray that was followed straight for this distance although it bends at the surface. */
float refracteddistance(float distance; float cosine; float eta) {
  return distance * abs(cosine) / cosineinside(cosine, eta);
}

#endif
