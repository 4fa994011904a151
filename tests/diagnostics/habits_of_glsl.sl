// What people write who come from GLSL, HLSL or OSL.
void main() { gl_FragColor = vec4(1, 0, 0, 1); } // expect-error: there is no variable 'gl_FragColor': surfaces set Ci and Oi // expect-error: there is no function 'vec4': use a color and a float
void twice(inout float x) { x *= 2; } // expect-error: the shading language has no 'inout': write 'output'
void thrice(out float x) { x = 3; } // expect-error: the shading language has no 'out': write 'output'
shader osl(float k = 1 [[ string label = "gain" ]], output color result = 0) { result = k; } // expect-error: 'shader' is neither a kind of shader (surface, displacement, light, volume, imager) nor a type
surface types(vec3 k = 1; in float m = 2) // expect-error: the shading language has no type 'vec3': use vector, point, normal or color // expect-error: the shading language has no 'in': leave it out, what is not declared 'output' is read-only
{
  vec3 a = vec3(1, 2, 3); // expect-error: the shading language has no type 'vec3': use vector, point, normal or color // expect-error: there is no function 'vec3': write color(x, y, z), vector(x, y, z), point(x, y, z) or normal(x, y, z)
  float2 st = 0; // expect-error: the shading language has no type 'float2': use two floats, or a triple
  mat4 x = 1; // expect-error: the shading language has no type 'mat4': use matrix
  float y = int(m); // expect-error: there is no function 'int': use floor(x), or round(x)
  twice(y);
  thrice(y);
  Ci = k * a * st * y;
}
surface members(float k = 1)
{
  float y = N.y, r = Cs.r; // expect-error: values have no members: write ycomp(N) // expect-error: values have no members: write comp(Cs, 0)
  Ci = color(Cs.rgb); // expect-error: values have no members: write Cs itself, all its components
  P.z = 1; // expect-error: values have no members: write setzcomp(P, value)
  Cs.r += 2; // expect-error: values have no members: write setcomp(Cs, 0, value)
  Ci = P[1] + Cs[3] + y + r; // expect-error: index 3 is outside array 'Cs' of 3 elements
  N[2] = k[0]; // expect-error: 'k' is no array
}
surface functions(matrix m = 1; string map = "")
{
  float a = dot(N, I), b = lerp(0, 1, s), c = saturate(a), d = fract(s), e = atan2(s, t); // expect-error: there is no function 'dot': RSL writes the dot product a . b // expect-error: there is no function 'lerp': use mix(a, b, t) // expect-error: there is no function 'saturate': use clamp(x, 0, 1) // expect-error: there is no function 'fract': use mod(x, 1) // expect-error: there is no function 'atan2': use atan(y, x)
  vector f = cross(N, I); // expect-error: there is no function 'cross': RSL writes the cross product a ^ b
  point p = m * P, q = mul(m, P); // expect-error: operator '*' cannot take (matrix, point); write transform(m, p), vtransform(m, v) or ntransform(m, n) // expect-error: there is no function 'mul': use transform(m, p), vtransform(m, v) or ntransform(m, n)
  Ci = tex2D(map) + rgb(1, 0, 0) + M_PI * uv; // expect-error: there is no function 'tex2D': use texture(name, s, t) // expect-error: there is no function 'rgb': write color(r, g, b) // expect-error: there is no variable 'M_PI': the constant is PI // expect-error: there is no variable 'uv': the parameters are u and v, the texture coordinates s and t
  matrix n = inverse(m) + 1; // expect-error: there is no function 'inverse': RSL writes the inverse of a matrix 1/m
}
surface closures(color tint = [1 0 0]; float gain = 1 [[ string label = "Gain" ]]) // expect-error: a triple stands in parentheses // expect-error: metadata in [[ ]] belongs to OSL
{
  closure color c = tint * diffuse(N); // expect-error: the shading language has no 'closure': leave it out, a surface computes its color itself, in Ci
  Ci = emission() + c; // expect-error: there is no function 'emission': add the color to Ci
  point p = transform(world, P); // expect-error: there is no variable 'world': names of spaces are strings and stand in quotes
}
