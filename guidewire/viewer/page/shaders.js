// @ts-check
/** Shaders of the fluoroscopic picture. Rows count from below here, from above in the core. */

/** A triangle over the whole picture. */
export const COVER = `#version 300 es
void main() { gl_Position = vec4(4.0 * float(gl_VertexID & 1) - 1.0, 2.0 * float(gl_VertexID & 2) - 1.0, 0.0, 1.0); }`;

/** The four corners of a piece's strip, with what is beyond its sides and ends. */
export const STRIP_CORNERS = `#version 300 es
precision highp float;
layout(location = 0) in vec4 placing; // x, y, direction
layout(location = 1) in vec4 extent;  // length, extent of the tilted end, part that is a strip, outer radius
layout(location = 2) in vec4 matter;  // inner radius, depth per chord, even depth, free ends
uniform vec2 pixels;
flat out vec4 place;
flat out vec4 size;
flat out vec4 wall;
void main() {
  place = placing;
  size = extent;
  wall = matter;
  float across = extent.w + 0.5 * (max(abs(placing.z), 1e-3) + max(abs(placing.w), 1e-3));
  float beyond = 0.5 * (extent.y + 1.0);
  float along = (gl_VertexID & 1) == 0 ? -beyond : extent.x + beyond;
  float side = (gl_VertexID & 2) == 0 ? -across : across;
  vec2 at = placing.xy + along * placing.zw + side * vec2(-placing.w, placing.z);
  gl_Position = vec4(2.0 * at.x / pixels.x - 1.0, 1.0 - 2.0 * at.y / pixels.y, 0.0, 1.0);
}`;

/** Optical depth of a piece in a pixel: StripProfile and InstrumentShadow of the core. */
export const STRIP = `#version 300 es
precision highp float;
const int PARTS = 6;
const float HALF_PI = 1.5707963;
uniform vec2 pixels;
flat in vec4 place;
flat in vec4 size;
flat in vec4 wall;
out vec4 depth;

float ramp(float x) { return x > 0.0 ? 0.5 * x * x : 0.0; }
float trapezoid(float x, float one, float other) {
  float outer = 0.5 * (one + other);
  float inner = 0.5 * (one - other);
  return (ramp(x + outer) - ramp(x + inner) - ramp(x - inner) + ramp(x - outer)) / (one * other);
}
float smoothed(float x, float width) {
  float outer = 0.5 * (width + 1.0);
  return x <= -outer ? 0.0 : x >= outer ? 1.0 : trapezoid(x, width, 1.0);
}
float chords(float u) {
  float v = clamp(u, -1.0, 1.0);
  return v * sqrt(1.0 - v * v) + asin(v);
}
float inWall(float s) {
  float outer = sqrt(max(0.0, size.w * size.w - s * s));
  return 2.0 * (outer - sqrt(max(0.0, wall.x * wall.x - s * s)));
}
float across(float distance, float one, float other) {
  float r = size.w;
  float a = wall.x;
  float wide = 0.5 * (one + other);
  float low = max(-r, distance - wide);
  float width = (min(r, distance + wide) - low) / float(PARTS);
  if (!(width > 0.0)) return 0.0;
  float chord = chords(low / r);
  float lumen = a > 0.0 ? chords(low / a) : 0.0;
  float side = inWall(low);
  float area = trapezoid(low - distance, one, other);
  float taken = 0.0;
  for (int k = 1; k <= PARTS; k++) {
    float edge = low + float(k) * width;
    float nextChord = chords(edge / r);
    float through = r * r * (nextChord - chord);
    chord = nextChord;
    if (a > 0.0) {
      float nextLumen = chords(edge / a);
      through -= a * a * (nextLumen - lumen);
      lumen = nextLumen;
    }
    float nextSide = inWall(edge);
    float spread = min(wall.y * abs(nextSide - side), 3.0);
    side = nextSide;
    float nextArea = trapezoid(edge - distance, one, other);
    float passed = exp(-(wall.y * through / width + wall.z)) * (1.0 + spread * spread / 24.0);
    taken += (nextArea - area) * (1.0 - passed);
    area = nextArea;
  }
  return -log(max(1.0 - taken, 1e-12));
}
void main() {
  vec2 at = vec2(gl_FragCoord.x, pixels.y - gl_FragCoord.y) - place.xy;
  float along = dot(at, place.zw);
  float full = across(at.y * place.z - at.x * place.w, max(abs(place.w), 1e-3), max(abs(place.z), 1e-3));
  float begins = smoothed(along, size.y);
  float ends = smoothed(along - size.x, size.y);
  int free = int(wall.w);
  bool isFreeEnd = ((free & 1) != 0 && begins < 1.0) || ((free & 2) != 0 && ends > 0.0);
  float window = (begins - ends) / size.z;
  depth = vec4(isFreeEnd && size.z == 1.0 ? -log(1.0 - window * (1.0 - exp(-full))) : window * full, 0.0, 0.0, 1.0);
}`;

/** Noise, as QuantumNoise of the core, and grey levels. */
const GREY = `
uniform float noise;
uniform uint seed;
uint mixed(uint h) {
  h ^= h >> 16;
  h *= 0x7feb352du;
  h ^= h >> 15;
  h *= 0x846ca68bu;
  return h ^ (h >> 16);
}
vec4 grey(float brightness, ivec2 at, ivec2 size) {
  if (noise > 0.0) {
    uint h = mixed(mixed(seed ^ 0x9e3779b9u) + uint((size.y - 1 - at.y) * size.x + at.x));
    uint pairs = (h & 0x00ff00ffu) + ((h >> 8) & 0x00ff00ffu);
    float deviation = (float((pairs & 0xffffu) + (pairs >> 16)) - 510.0) / 147.80054;
    brightness += noise * sqrt(brightness) * deviation;
  }
  return vec4(vec3(floor(255.0 * clamp(brightness, 0.0, 1.0) + 0.5) / 255.0), 1.0);
}`;

/** Grey levels of background, vessel and instruments; or their brightness, of a mask. */
export const COMPOSE = `#version 300 es
precision highp float;
precision highp int;
uniform highp sampler2D layer;
uniform highp sampler2D depth;
uniform highp sampler2D mask;
uniform bool isLast;
uniform float subtracted; // brightness where nothing has changed; 0: nothing is subtracted
uniform ivec2 shift;      // of the mask
uniform float clear;      // brightness below which instruments are light, so that one sees them; 0: nowhere
out vec4 colour;
${GREY}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  ivec2 size = textureSize(layer, 0);
  float through = texelFetch(depth, at, 0).r;
  float brightness = texelFetch(layer, ivec2(at.x, size.y - 1 - at.y), 0).r;
  if (through > 0.0) brightness = brightness < clear ? mix(1.0, brightness, exp(-through)) : brightness * exp(-through);
  if (subtracted > 0.0) {
    brightness *= subtracted / max(texelFetch(mask, clamp(at - shift, ivec2(0), size - 1), 0).r, 1e-4);
  }
  colour = isLast ? grey(brightness, at, size) : vec4(brightness, 0.0, 0.0, 1.0);
}`;
