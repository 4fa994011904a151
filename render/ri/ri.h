// The C binding of the RenderMan Interface, version 3.2, with the requests of later renderers that RIB files
// of Anemone may use. PUBLIC. For C (C99 and later; older programs compile as well) and C++;
// docs/c-interface.md shows how programs are built.
//
//   RiBegin(RI_NULL) renders in this process, or, where the environment has ANEMONE_RIB, writes the file
//   named there. RiBegin("scene.rib") writes a RIB file, RiBegin("-") RIB to standard output.
//
// Conventions. Points and vectors are three RtFloat, matrices four rows of four that multiply row vectors
// from the right, angles degrees, colours three components. A parameter list is pairs of a token and a
// pointer to its values, ended by RI_NULL; functions named ...V take its length and two arrays instead. How
// many values a token has follows from its declaration (RiDeclare, or in the token: "uniform float Kd";
// standard names need none) and from the primitive: RISpec 3.2, section 5. "integer" values are RtInt,
// strings RtString, all others RtFloat. Nothing that is handed over is kept: all is copied before a function
// returns.
//
// Errors go to the handler of RiErrorHandler, which is RiErrorPrint at first; the request in question is
// skipped. Functions must not be called from two threads at once.
#pragma once

#if !defined(__cplusplus)
#define RI_NULL ((void*)0)
#elif __cplusplus >= 201103L
#define RI_NULL nullptr
#else
#define RI_NULL 0L
#endif

#ifdef __cplusplus
extern "C" {
#endif

#ifdef __GNUC__
#define PRMANEXPORT __attribute__((visibility("default"))) // how plug-ins mark what they offer
#else
#define PRMANEXPORT
#endif

// Types

typedef short RtBoolean;
typedef int RtInt;
typedef float RtFloat;
#ifdef __cplusplus
typedef const char* RtToken; // C++ has no way from a text in quotes to char*
typedef const char* RtString;
#else
typedef char* RtToken;
typedef char* RtString;
#endif
typedef RtFloat RtColor[3];
typedef RtFloat RtPoint[3];
typedef RtFloat RtVector[3];
typedef RtFloat RtNormal[3];
typedef RtFloat RtHpoint[4];
typedef RtFloat RtMatrix[4][4];
typedef RtFloat RtBasis[4][4];
typedef RtFloat RtBound[6]; // xmin xmax ymin ymax zmin zmax
typedef RtFloat RtInterval[2];
typedef void* RtPointer;
typedef void RtVoid;

typedef RtPointer RtObjectHandle;
typedef RtPointer RtLightHandle;
typedef RtPointer RtContextHandle;
typedef RtPointer RtArchiveHandle;

// Weight of a sample at (x, y) pixels from the centre of a filter of the given widths.
typedef RtFloat (*RtFilterFunc)(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
typedef RtFloat (*RtFloatFunc)(RtFloat, RtFloat, RtFloat, RtFloat);
typedef RtVoid (*RtErrorHandler)(RtInt code, RtInt severity, char* message);
typedef RtErrorHandler RtErrorFunc;
// Makes geometry; `detail` is the area in pixels that its bound covers.
typedef RtVoid (*RtProcSubdivFunc)(RtPointer data, RtFloat detail);
typedef RtVoid (*RtProcFreeFunc)(RtPointer data);
typedef RtVoid (*RtFunc)(RtPointer, RtFloat);
// Gets "comment" or "structure", the format "%s" and the text.
typedef RtVoid (*RtArchiveCallback)(RtToken type, char* format, ...);

// Constants

#define RI_FALSE 0
#define RI_TRUE 1
#define RI_INFINITY ((RtFloat)1.0e38)
#define RI_EPSILON ((RtFloat)1.0e-10)

#define RI_BEZIERSTEP ((RtInt)3)
#define RI_BSPLINESTEP ((RtInt)1)
#define RI_CATMULLROMSTEP ((RtInt)1)
#define RI_HERMITESTEP ((RtInt)2)
#define RI_POWERSTEP ((RtInt)4)

// Codes of errors
#define RIE_NOERROR 0
#define RIE_NOMEM 1      // out of memory
#define RIE_SYSTEM 2     // the system refused something
#define RIE_NOFILE 3     // a file does not exist
#define RIE_BADFILE 4    // a file cannot be read or written
#define RIE_VERSION 5    // a file of another version
#define RIE_DISKFULL 6   // no room for output
#define RIE_INCAPABLE 11 // an optional feature
#define RIE_OPTIONAL RIE_INCAPABLE
#define RIE_UNIMPLEMENT 12
#define RIE_LIMIT 13
#define RIE_BUG 14        // of Anemone
#define RIE_NOTSTARTED 23 // RiBegin is missing
#define RIE_NESTING 24    // blocks that do not match
#define RIE_NOTOPTIONS 25 // options inside a world
#define RIE_NOTATTRIBS 26
#define RIE_NOTPRIMS 27 // primitives outside a world
#define RIE_ILLSTATE 28
#define RIE_BADMOTION 29
#define RIE_BADSOLID 30
#define RIE_BADTOKEN 41 // a name that is not known or not declared
#define RIE_RANGE 42
#define RIE_CONSISTENCY 43
#define RIE_BADHANDLE 44
#define RIE_NOSHADER 45
#define RIE_MISSINGDATA 46
#define RIE_SYNTAX 47
#define RIE_MATH 61
// Severities
#define RIE_INFO 0
#define RIE_WARNING 1
#define RIE_ERROR 2
#define RIE_SEVERE 3

extern RtInt RiLastError; // code of the last error

// Tokens
extern RtToken RI_FRAMEBUFFER, RI_FILE;
extern RtToken RI_RGB, RI_RGBA, RI_RGBZ, RI_RGBAZ, RI_A, RI_Z, RI_AZ;
extern RtToken RI_MERGE, RI_ORIGIN;
extern RtToken RI_PERSPECTIVE, RI_ORTHOGRAPHIC;
extern RtToken RI_HIDDEN, RI_PAINT;
extern RtToken RI_CONSTANT, RI_SMOOTH;
extern RtToken RI_FLATNESS, RI_FOV;
extern RtToken RI_AMBIENTLIGHT, RI_POINTLIGHT, RI_DISTANTLIGHT, RI_SPOTLIGHT;
extern RtToken RI_INTENSITY, RI_LIGHTCOLOR, RI_FROM, RI_TO, RI_CONEANGLE, RI_CONEDELTAANGLE,
    RI_BEAMDISTRIBUTION;
extern RtToken RI_MATTE, RI_METAL, RI_SHINYMETAL, RI_PLASTIC, RI_PAINTEDPLASTIC;
extern RtToken RI_KA, RI_KD, RI_KS, RI_KR, RI_ROUGHNESS, RI_TEXTURENAME, RI_SPECULARCOLOR;
extern RtToken RI_DEPTHCUE, RI_FOG, RI_BUMPY;
extern RtToken RI_MINDISTANCE, RI_MAXDISTANCE, RI_DISTANCE, RI_BACKGROUND, RI_AMPLITUDE;
extern RtToken RI_INSIDE, RI_OUTSIDE, RI_LH, RI_RH;
extern RtToken RI_P, RI_PZ, RI_PW, RI_N, RI_NP, RI_CS, RI_OS, RI_S, RI_T, RI_ST, RI_WIDTH, RI_CONSTANTWIDTH;
extern RtToken RI_BILINEAR, RI_BICUBIC, RI_LINEAR, RI_CUBIC;
extern RtToken RI_PRIMITIVE, RI_INTERSECTION, RI_UNION, RI_DIFFERENCE;
extern RtToken RI_PERIODIC, RI_NONPERIODIC, RI_CLAMP, RI_BLACK;
extern RtToken RI_IGNORE, RI_PRINT, RI_ABORT, RI_HANDLER;
extern RtToken RI_COMMENT, RI_STRUCTURE, RI_VERBATIM;
extern RtToken RI_IDENTIFIER, RI_NAME, RI_SHADINGGROUP, RI_LIGHTSOURCE;
extern RtToken RI_CATMULLCLARK, RI_HOLE, RI_CREASE, RI_CORNER, RI_INTERPOLATEBOUNDARY;
extern RtToken RI_RASTER, RI_SCREEN, RI_CAMERA, RI_WORLD, RI_OBJECT, RI_NDC, RI_CURRENT, RI_SHADER;
extern RtToken RI_LIMITS, RI_BUCKETSIZE, RI_GRIDSIZE, RI_SEARCHPATH, RI_TEXTURE, RI_ARCHIVE, RI_PROCEDURAL;

// Bases of cubic patches and curves
extern RtBasis RiBezierBasis, RiBSplineBasis, RiCatmullRomBasis, RiHermiteBasis, RiPowerBasis;

// Filters for RiPixelFilter and RiMake...; they can be called, too
RtFloat RiBoxFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiTriangleFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiGaussianFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiCatmullRomFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiSincFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiBSplineFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiMitchellFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiDiskFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiSeparableCatmullRomFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiBlackmanHarrisFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiLanczosFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiBesselFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);

// Contexts
RtVoid RiBegin(RtToken name);
RtVoid RiEnd(void);
RtContextHandle RiGetContext(void);
RtVoid RiContext(RtContextHandle handle);

// Errors
RtVoid RiErrorHandler(RtErrorHandler handler);
RtVoid RiErrorIgnore(RtInt code, RtInt severity, char* message);
RtVoid RiErrorPrint(RtInt code, RtInt severity, char* message);
RtVoid RiErrorAbort(RtInt code, RtInt severity, char* message);

// Blocks
RtVoid RiFrameBegin(RtInt number);
RtVoid RiFrameEnd(void);
RtVoid RiWorldBegin(void);
RtVoid RiWorldEnd(void);
RtVoid RiAttributeBegin(void);
RtVoid RiAttributeEnd(void);
RtVoid RiTransformBegin(void);
RtVoid RiTransformEnd(void);
RtVoid RiSolidBegin(RtToken operation);
RtVoid RiSolidEnd(void);
RtObjectHandle RiObjectBegin(void);
RtVoid RiObjectEnd(void);
RtVoid RiObjectInstance(RtObjectHandle handle);
RtVoid RiMotionBegin(RtInt n, ...); // n times, each a double
RtVoid RiMotionBeginV(RtInt n, RtFloat times[]);
RtVoid RiMotionEnd(void);

// Camera and image options
RtVoid RiFormat(RtInt xres, RtInt yres, RtFloat pixelaspect);
RtVoid RiFrameAspectRatio(RtFloat aspect);
RtVoid RiScreenWindow(RtFloat left, RtFloat right, RtFloat bottom, RtFloat top);
RtVoid RiCropWindow(RtFloat xmin, RtFloat xmax, RtFloat ymin, RtFloat ymax);
RtVoid RiProjection(RtToken name, ...);
RtVoid RiProjectionV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiClipping(RtFloat near_, RtFloat far_);
RtVoid RiClippingPlane(RtFloat x, RtFloat y, RtFloat z, RtFloat nx, RtFloat ny, RtFloat nz);
RtVoid RiDepthOfField(RtFloat fstop, RtFloat focallength, RtFloat focaldistance); // RI_INFINITY: a pinhole
RtVoid RiShutter(RtFloat open, RtFloat close);
RtVoid RiPixelVariance(RtFloat variance);
RtVoid RiPixelSamples(RtFloat x, RtFloat y);
RtVoid RiPixelFilter(RtFilterFunc filter, RtFloat xwidth, RtFloat ywidth);
RtVoid RiExposure(RtFloat gain, RtFloat gamma);
RtVoid RiImager(RtToken name, ...);
RtVoid RiImagerV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiQuantize(RtToken type, RtInt one, RtInt min, RtInt max, RtFloat dither);
RtVoid RiDisplay(RtToken name, RtToken type, RtToken mode, ...);
RtVoid RiDisplayV(RtToken name, RtToken type, RtToken mode, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiDisplayChannel(RtToken name, ...);
RtVoid RiDisplayChannelV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiHider(RtToken type, ...);
RtVoid RiHiderV(RtToken type, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiColorSamples(RtInt n, RtFloat nRGB[], RtFloat RGBn[]);
RtVoid RiRelativeDetail(RtFloat detail);
RtVoid RiOption(RtToken name, ...);
RtVoid RiOptionV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]);

// Attributes
RtVoid RiAttribute(RtToken name, ...);
RtVoid RiAttributeV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiColor(RtColor color);
RtVoid RiOpacity(RtColor opacity);
RtVoid RiTextureCoordinates(RtFloat s1, RtFloat t1, RtFloat s2, RtFloat t2, RtFloat s3, RtFloat t3,
                            RtFloat s4, RtFloat t4);
RtLightHandle RiLightSource(RtToken name, ...);
RtLightHandle RiLightSourceV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]);
RtLightHandle RiAreaLightSource(RtToken name, ...);
RtLightHandle RiAreaLightSourceV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiIlluminate(RtLightHandle light, RtBoolean on);
RtVoid RiSurface(RtToken name, ...);
RtVoid RiSurfaceV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiDisplacement(RtToken name, ...);
RtVoid RiDisplacementV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiAtmosphere(RtToken name, ...);
RtVoid RiAtmosphereV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiInterior(RtToken name, ...);
RtVoid RiInteriorV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiExterior(RtToken name, ...);
RtVoid RiExteriorV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiDeformation(RtToken name, ...);
RtVoid RiDeformationV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiShadingRate(RtFloat area);
RtVoid RiShadingInterpolation(RtToken type);
RtVoid RiMatte(RtBoolean on);
RtVoid RiBound(RtBound bound);
RtVoid RiDetail(RtBound bound);
RtVoid RiDetailRange(RtFloat offlow, RtFloat onlow, RtFloat onhigh, RtFloat offhigh);
RtVoid RiGeometricApproximation(RtToken type, RtFloat value);
RtVoid RiOrientation(RtToken orientation);
RtVoid RiReverseOrientation(void);
RtVoid RiSides(RtInt sides);
RtVoid RiBasis(RtBasis ubasis, RtInt ustep, RtBasis vbasis, RtInt vstep);
RtVoid RiTrimCurve(RtInt nloops, RtInt ncurves[], RtInt order[], RtFloat knot[], RtFloat min[], RtFloat max[],
                   RtInt n[], RtFloat u[], RtFloat v[], RtFloat w[]);

// Transformations
RtVoid RiIdentity(void);
RtVoid RiTransform(RtMatrix matrix);
RtVoid RiConcatTransform(RtMatrix matrix);
RtVoid RiPerspective(RtFloat fov);
RtVoid RiTranslate(RtFloat dx, RtFloat dy, RtFloat dz);
RtVoid RiRotate(RtFloat angle, RtFloat dx, RtFloat dy, RtFloat dz);
RtVoid RiScale(RtFloat sx, RtFloat sy, RtFloat sz);
RtVoid RiSkew(RtFloat angle, RtFloat dx1, RtFloat dy1, RtFloat dz1, RtFloat dx2, RtFloat dy2, RtFloat dz2);
RtVoid RiCoordinateSystem(RtToken name);
RtVoid RiScopedCoordinateSystem(RtToken name);
RtVoid RiCoordSysTransform(RtToken name);
// Takes n points from one space to another, in place, and returns them; RI_NULL when a space is not known, or
// in a context that writes a file.
RtPoint* RiTransformPoints(RtToken fromspace, RtToken tospace, RtInt n, RtPoint points[]);

// Geometry
RtVoid RiSphere(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, ...);
RtVoid RiSphereV(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, RtInt n, RtToken tokens[],
                 RtPointer values[]);
RtVoid RiCone(RtFloat height, RtFloat radius, RtFloat thetamax, ...);
RtVoid RiConeV(RtFloat height, RtFloat radius, RtFloat thetamax, RtInt n, RtToken tokens[],
               RtPointer values[]);
RtVoid RiCylinder(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, ...);
RtVoid RiCylinderV(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, RtInt n, RtToken tokens[],
                   RtPointer values[]);
RtVoid RiHyperboloid(RtPoint point1, RtPoint point2, RtFloat thetamax, ...);
RtVoid RiHyperboloidV(RtPoint point1, RtPoint point2, RtFloat thetamax, RtInt n, RtToken tokens[],
                      RtPointer values[]);
RtVoid RiParaboloid(RtFloat rmax, RtFloat zmin, RtFloat zmax, RtFloat thetamax, ...);
RtVoid RiParaboloidV(RtFloat rmax, RtFloat zmin, RtFloat zmax, RtFloat thetamax, RtInt n, RtToken tokens[],
                     RtPointer values[]);
RtVoid RiDisk(RtFloat height, RtFloat radius, RtFloat thetamax, ...);
RtVoid RiDiskV(RtFloat height, RtFloat radius, RtFloat thetamax, RtInt n, RtToken tokens[],
               RtPointer values[]);
RtVoid RiTorus(RtFloat majorradius, RtFloat minorradius, RtFloat phimin, RtFloat phimax, RtFloat thetamax,
               ...);
RtVoid RiTorusV(RtFloat majorradius, RtFloat minorradius, RtFloat phimin, RtFloat phimax, RtFloat thetamax,
                RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiPolygon(RtInt nvertices, ...);
RtVoid RiPolygonV(RtInt nvertices, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiGeneralPolygon(RtInt nloops, RtInt nvertices[], ...);
RtVoid RiGeneralPolygonV(RtInt nloops, RtInt nvertices[], RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiPointsPolygons(RtInt npolys, RtInt nvertices[], RtInt vertices[], ...);
RtVoid RiPointsPolygonsV(RtInt npolys, RtInt nvertices[], RtInt vertices[], RtInt n, RtToken tokens[],
                         RtPointer values[]);
RtVoid RiPointsGeneralPolygons(RtInt npolys, RtInt nloops[], RtInt nvertices[], RtInt vertices[], ...);
RtVoid RiPointsGeneralPolygonsV(RtInt npolys, RtInt nloops[], RtInt nvertices[], RtInt vertices[], RtInt n,
                                RtToken tokens[], RtPointer values[]);
RtVoid RiPatch(RtToken type, ...);
RtVoid RiPatchV(RtToken type, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiPatchMesh(RtToken type, RtInt nu, RtToken uwrap, RtInt nv, RtToken vwrap, ...);
RtVoid RiPatchMeshV(RtToken type, RtInt nu, RtToken uwrap, RtInt nv, RtToken vwrap, RtInt n, RtToken tokens[],
                    RtPointer values[]);
RtVoid RiNuPatch(RtInt nu, RtInt uorder, RtFloat uknot[], RtFloat umin, RtFloat umax, RtInt nv, RtInt vorder,
                 RtFloat vknot[], RtFloat vmin, RtFloat vmax, ...);
RtVoid RiNuPatchV(RtInt nu, RtInt uorder, RtFloat uknot[], RtFloat umin, RtFloat umax, RtInt nv, RtInt vorder,
                  RtFloat vknot[], RtFloat vmin, RtFloat vmax, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiSubdivisionMesh(RtToken scheme, RtInt nfaces, RtInt nvertices[], RtInt vertices[], RtInt ntags,
                         RtToken tags[], RtInt nargs[], RtInt intargs[], RtFloat floatargs[], ...);
RtVoid RiSubdivisionMeshV(RtToken scheme, RtInt nfaces, RtInt nvertices[], RtInt vertices[], RtInt ntags,
                          RtToken tags[], RtInt nargs[], RtInt intargs[], RtFloat floatargs[], RtInt n,
                          RtToken tokens[], RtPointer values[]);
RtVoid RiPoints(RtInt npoints, ...);
RtVoid RiPointsV(RtInt npoints, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiCurves(RtToken type, RtInt ncurves, RtInt nvertices[], RtToken wrap, ...);
RtVoid RiCurvesV(RtToken type, RtInt ncurves, RtInt nvertices[], RtToken wrap, RtInt n, RtToken tokens[],
                 RtPointer values[]);
RtVoid RiBlobby(RtInt nleaf, RtInt ncode, RtInt code[], RtInt nfloats, RtFloat floats[], RtInt nstrings,
                RtString strings[], ...);
RtVoid RiBlobbyV(RtInt nleaf, RtInt ncode, RtInt code[], RtInt nfloats, RtFloat floats[], RtInt nstrings,
                 RtString strings[], RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiGeometry(RtToken type, ...);
RtVoid RiGeometryV(RtToken type, RtInt n, RtToken tokens[], RtPointer values[]);

// Procedurals. `subdivfunc` is called, when the bound is seen, while the world is closed; it makes requests.
// `freefunc`, which may be RI_NULL, follows, also where the bound is not seen. The three functions below can
// stand for it; their data is an array of strings, which is copied: the file, the program and its data, the
// plug-in and its parameters.
RtVoid RiProcedural(RtPointer data, RtBound bound, RtProcSubdivFunc subdivfunc, RtProcFreeFunc freefunc);
RtVoid RiProcDelayedReadArchive(RtPointer data, RtFloat detail);
RtVoid RiProcRunProgram(RtPointer data, RtFloat detail);
RtVoid RiProcDynamicLoad(RtPointer data, RtFloat detail);
RtVoid RiProcFree(RtPointer data); // free() of the C library

// Archives, conditions
RtVoid RiReadArchive(RtToken name, RtArchiveCallback callback, ...);
RtVoid RiReadArchiveV(RtToken name, RtArchiveCallback callback, RtInt n, RtToken tokens[],
                      RtPointer values[]);
RtArchiveHandle RiArchiveBegin(RtToken name, ...);
RtArchiveHandle RiArchiveBeginV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiArchiveEnd(void);
RtVoid RiArchiveInstance(RtToken name, ...);
RtVoid RiArchiveInstanceV(RtToken name, RtInt n, RtToken tokens[], RtPointer values[]);
// `type` is "comment", "structure" or "verbatim"; format and arguments are printf's. Only the last means
// something to a renderer: it is RIB.
RtVoid RiArchiveRecord(RtToken type, char const* format, ...);
RtVoid RiIfBegin(RtToken condition, ...);
RtVoid RiIfBeginV(RtToken condition, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiElseIf(RtToken condition, ...);
RtVoid RiElseIfV(RtToken condition, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiElse(void);
RtVoid RiIfEnd(void);
RtToken RiDeclare(RtToken name, RtToken declaration); // returns `name`

// Maps
RtVoid RiMakeTexture(RtToken image, RtToken texture, RtToken swrap, RtToken twrap, RtFilterFunc filter,
                     RtFloat swidth, RtFloat twidth, ...);
RtVoid RiMakeTextureV(RtToken image, RtToken texture, RtToken swrap, RtToken twrap, RtFilterFunc filter,
                      RtFloat swidth, RtFloat twidth, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiMakeBump(RtToken image, RtToken bump, RtToken swrap, RtToken twrap, RtFilterFunc filter,
                  RtFloat swidth, RtFloat twidth, ...);
RtVoid RiMakeBumpV(RtToken image, RtToken bump, RtToken swrap, RtToken twrap, RtFilterFunc filter,
                   RtFloat swidth, RtFloat twidth, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiMakeLatLongEnvironment(RtToken image, RtToken texture, RtFilterFunc filter, RtFloat swidth,
                                RtFloat twidth, ...);
RtVoid RiMakeLatLongEnvironmentV(RtToken image, RtToken texture, RtFilterFunc filter, RtFloat swidth,
                                 RtFloat twidth, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiMakeCubeFaceEnvironment(RtToken px, RtToken nx, RtToken py, RtToken ny, RtToken pz, RtToken nz,
                                 RtToken texture, RtFloat fov, RtFilterFunc filter, RtFloat swidth,
                                 RtFloat twidth, ...);
RtVoid RiMakeCubeFaceEnvironmentV(RtToken px, RtToken nx, RtToken py, RtToken ny, RtToken pz, RtToken nz,
                                  RtToken texture, RtFloat fov, RtFilterFunc filter, RtFloat swidth,
                                  RtFloat twidth, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiMakeShadow(RtToken zfile, RtToken shadow, ...);
RtVoid RiMakeShadowV(RtToken zfile, RtToken shadow, RtInt n, RtToken tokens[], RtPointer values[]);
RtVoid RiMakeOcclusion(RtInt nfiles, RtString zfiles[], RtToken shadow, ...);
RtVoid RiMakeOcclusionV(RtInt nfiles, RtString zfiles[], RtToken shadow, RtInt n, RtToken tokens[],
                        RtPointer values[]);
RtVoid RiMakeBrickMap(RtInt nclouds, RtString pointclouds[], RtToken brickmap, ...);
RtVoid RiMakeBrickMapV(RtInt nclouds, RtString pointclouds[], RtToken brickmap, RtInt n, RtToken tokens[],
                       RtPointer values[]);

#ifdef __cplusplus
}
#endif
