/* scales.sl: skin of a fish in relief: rows of scales, the edge of the gill cover, the mouth. Shader space is that of fishskin.sl. */
displacement
scales(uniform float size = 0.04, height = 0.0022;
       uniform float gill = 0.014;  /* depth of the groove behind the gill cover; 0: none */
       uniform float mouth = 0.012; /* of the line of the mouth */
       )
{
  point q = transform("shader", P);
  float x = zcomp(q) / size, y = ycomp(q) / size;
  float row = floor(y), fx = mod(x + 0.5 * mod(row, 2), 1) - 0.5, fy = y - row - 0.5;
  float tile = 1 - smoothstep(0.25, 0.62, sqrt(fx * fx + fy * fy));
  float body = 1 - smoothstep(0.42, 0.5, zcomp(q));
  float bend = ycomp(q) - 0.02;
  float cover = zcomp(q) - (0.46 + 0.7 * bend * bend);
  float groove = smoothstep(-0.035, -0.005, cover) * (1 - smoothstep(0, 0.012, cover)) * (1 - smoothstep(0.16, 0.3, abs(bend)));
  float lips = 0;
  if (zcomp(q) > 0.85) {
    float corner = 1 - zcomp(q), off = ycomp(q) + 0.155 + 0.9 * corner * corner;
    lips = (1 - smoothstep(0.003, 0.012, abs(off))) * (1 - smoothstep(0.11, 0.14, corner));
  }
  normal n = normalize(N);
  P += (height * body * tile - gill * groove - mouth * lips) * n / length(vtransform("shader", n));
  N = calculatenormal(P);
}
