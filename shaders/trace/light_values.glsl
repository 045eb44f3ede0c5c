// The light of pictures, linear and for the CPU (src/trace/integrate.cpp) and devices alike: each defines LIGHT(name,
// red, green, blue) for a colour, an albedo or a direction, and LIGHT_NUMBER(name, value), and includes this.
LIGHT(sunlight, 2.6, 2.35, 1.9)
LIGHT(haze, 1.1, 1.3, 1.5)             // the sky at the horizon and below
LIGHT(zenith, 0.35, 0.7, 1.4)          // the sky above
LIGHT(shade, 0.5, 0.6, 0.7)            // the sky of the integrator `shadow`, from all sides
LIGHT(sunDirection, 0.45, 0.75, 0.42)  // of any length
LIGHT(gridAlbedo, 0.36, 0.33, 0.28)    // of compressed grids without colours
LIGHT_NUMBER(openLight, 1.6)           // AO where nothing is near
LIGHT_NUMBER(headlightLeast, 0.4)      // `primary`, on surfaces seen from the side
LIGHT_NUMBER(headlightMore, 1.4)       // and that much more on those that face the camera
