"""What may be meant in a config, but mostly is not, written into that of mistakes.py."""
from mistakes import CAMERA, NARROW_VIEW, SWEEP, VIEW_TO_MASKS

# Warned of before anything renders. What is written in place of what; the line that is named; words of the message.
WARNINGS = {
    "a camera far away": (CAMERA, "camera: {position: [0, 1, 60], target: [0, 1, 0], fov_deg: 50}", 4,
                          "surfaces fill less than 1 % of its view: it stands at [0, 1, 60], 59 m away from a scene that reaches "
                          "from [-1, 0, -1] to [1, 2, 1]; are its numbers metres?"),
    "radians for degrees": ("fov_deg: 50", "fov_deg: 1.05", 4, "1.05 in radians is 60.16 degrees"),
    "no direct light": ("  - {pass: direct_shadow_rays, id: direct}\n", "", 16,
                        "lacks direct light, which the reference has; these can: direct_shadow_maps, direct_shadow_rays,"),
    "metal, and no pass that follows its reflections": (
        "  lights:", "  override: {grey: {metallic: 1}}\n  lights:", 2,
        "of the surfaces in view are metal, which reflects by specular lobes alone: the reference has what they reflect of indirect light"),
    "two writers of the image": ("  - {pass: composite}", "  - {pass: composite}\n  - {pass: composite, id: again}", 17,
                                 "'composite' is never run: 'again', after it, writes 'final' too, and the last one counts"),
    "voxels that no pass reads": ("  - {pass: voxelize", "  - {pass: voxelize, id: coarse, resolution: 8}\n  - {pass: voxelize", 11,
                                  "'coarse' is never run: 'voxelize', after it, writes 'voxels' too"),
    "a light that points past the scene": ("{point: [0, 1.8, 0],", "{spot: [0, 1.8, 3], direction: [0, 0, 1],", 6,
                                           "scene.lights[0]: it lights nothing"),
    "a light that shines upwards": (
        "  lights:\n    - {point: [0, 1.8, 0], intensity", "  boxes: false\n  lights:\n    - {directional: [0, 1, 0], irradiance", 7,
        "it lights the backs of surfaces alone"),
    "a sun that shines upwards, and no lamp": (
        "  lights:\n    - {point: [0, 1.8, 0], intensity: [1, 1, 1]}",
        "  override: {lamp: {emission: 0}}\n  lights:\n    - {directional: [0, 1, 0], irradiance: 5}", 7,
        "black: light travels along [0, 1, 0], upwards (scene.lights[0]); is that the way of the light, not the way to it?"),
    "radians for a spot's degrees": ("{point: [0, 1.8, 0],", "{spot: [0, 1.8, 0], outer_deg: 0.5,", 6,
                                     "scene.lights[0].outer_deg: 0.5 degrees are a thin beam's; 0.5 in radians is 28.65 degrees"),
    "a black light": ("intensity: [1, 1, 1]", "intensity: 0", 6, "scene.lights[0]: it is black and lights nothing"),
    "a lamp of 80000 W/sr": ("intensity: [1, 1, 1]", "intensity: 80000", 6,
                             "scene.lights[0]: nearly all of the view is white: its radiance is about"),
    "a lamp in a box": ("point: [0, 1.8, 0]", "point: [-0.35, 0.6, -0.3]", 6,
                        "scene.lights[0]: none of its light comes to what the camera sees: does it stand inside of an object"),
    "a sky in bytes": ("  lights:", "  environment: [135, 206, 235]\n  lights:", 5,
                       "as a color of 0 to 255 it is [0.2423, 0.6172, 0.8308]"),
    "a light in centimetres": ("point: [0, 1.8, 0]", "point: [0, 180, 0]", 6, "are its numbers metres?"),
    "frames added up where there are none": (
        "  - {pass: filter_irradiance, id: indirect, inputs: {noisy_irradiance: gather}}",
        "  - {pass: accumulate}\n  - {pass: filter_irradiance, id: indirect}", 15,
        "accumulate: it goes on from frame to frame, and 3 of the 15 frames that it looks back on come before"),
    "a scene that is added in metres among centimetres": (
        "  lights:", "  add: [{builtin: white_room, transform: {scale: [0.01, 0.005, 0.01]}}]\n  lights:", 5,
        "scene.add[0]: 'white_room' is 0.03 m across, the scene that it is added to 3.46 m; is one of the two in centimetres? "
        "then write transform: {scale: [1, 0.5, 1]}"),
    "a scene that is added in centimetres": (
        "  lights:", "  add: [{builtin: white_room, transform: {scale: 100}}]\n  lights:", 5,
        "'white_room' is 346 m across, the scene that it is added to 3.46 m; is one of the two in centimetres? then write "
        "transform: {scale: 1}"),
    "a scene that is added far away": ("  lights:", "  add: [{builtin: mirror_row, transform: {translate: [0, 370, 0]}}]\n  lights:", 5,
                                       "m away; is its 'translate' in metres?"),
    "lights that the scene lacks": ("  lights:", "  keep_file_lights: false\n  lights:", 5, "the scene has no punctual lights"),
    "spheres that have no time to move": ("  lights:", "  moving_spheres: {count: 1, center: [0, 1, 0]}\n  lights:", 5,
                                          "they stand still; for ones that move write 'time_step'"),
    "a sweep of the value that is written": ("[4096, 8192]", "[4096]", 20,
                                             "sweep.inject.rays_per_light: its one value, 4096, is the one that is written anyway"),
    "a sweep of the pass that is written": ("inject.rays_per_light: [4096, 8192]", "gather: [gather_rays]", 20,
                                            "sweep.gather: its one value, gather_rays, is the one that is written anyway"),
    "a reference that can't be halved": ("spp: 8", "spp: 3", 18,
                                         "reference.spp: of 3 samples a pixel one half of the reference has 1, the other 2"),
    "a mask of what is not in view": (VIEW_TO_MASKS, NARROW_VIEW.replace("material: grey", "material: lamp"), 21,
                                      "measure.masks.floor: it selects no pixel and has no scores: what meets its conditions is out of sight"),
    "a mask of what no surface is": ("masks: {floor: {material: grey}}", "masks: {floor: {material: grey, min_metallic: 0.5}}", 21,
                                     "no surface of the scene meets all of its conditions"),
    "a mask of all that is in view": (VIEW_TO_MASKS, NARROW_VIEW.replace("material: grey", "max_roughness: 1"), 21,
                                      "measure.masks.floor: it selects every pixel, so that its scores are those of the whole image"),
    "a variant that needs more memory": (
        SWEEP + "measure: {frames: 2", "sweep:\n  voxelize.resolution: [16, 1024]\nmeasure: {memory_limit_mb: 40, frames: 2", 21,
        "too few for 1 of 2 variants: resolution 1024 takes at least"),
}
