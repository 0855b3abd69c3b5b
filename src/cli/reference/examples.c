/* These lists hold the examples of the manual, and the variables of the environment that it speaks of. */
#include "cli/reference/manual.h"

const struct kd_example kd_examples[] = {
    { "render", "kerrd render -o hole.png", "The default scene:" },
    { "render", "kerrd render --preset gargantua --size 640x360 --set camera.roll_deg=20 -o tilted.png", "A scene that is known by name, with one field changed:" },
    { "render", "kerrd render --from hole.png --set disk.outer=30 --size 640x360 -o wide.png", "The scene inside a picture once more, with a wider disk:" },
    { "render", "kerrd render --size 320x180 --set image.layers=rgb,g,r -o maps.fits", "Redshift and radius of each pixel beside the picture:" },
    { "view", "kerrd view --preset gargantua --size 640x360 --protocol sixel > picture.six", "A picture for a terminal that cannot be asked:" },
    { "view", "kerrd view --from hole.png --protocol kitty > picture.kitty", "The same by the other protocol, of the scene inside a picture:" },
    { "view", "kerrd view hole.png --protocol kitty > picture.kitty", "A picture that is there, and a line that tells its scene:" },
    { "light-curve", "kerrd light-curve --preset hot-spot --size 160x90 --frames 24 -o flare.csv", "Flux and centroid over one orbit of a hot spot:" },
    { "sweep", "kerrd sweep --size 160x90 -x spacetime.spin=0,0.9 -x camera.inclination_deg=30:70:20 -o sweep.fits", "Six scenes, two spins by three inclinations, as one array:" },
    { "film", "kerrd film - --size 160x90 -o turn.zip <<< '{\"scene\": {}, \"keyframes\": [{\"frame\": 3, \"scene\": {\"camera\": {\"inclination_deg\": 60}}}]}'", "Four numbered pictures, from the default inclination to another one:" },
    { "particles", "kerrd particles --preset living-disk --count 1000 --fields x,y,z -o particles.npy", "Where a thousand particles are:" },
    { "rays", "kerrd rays --spin 0.9 --inclination-deg 60 --ray -5,1", "Where one ray ends:" },
    { "rays", "kerrd rays --spin 0.9 --inclination-deg 60 --ray -5,1 --trace=path --format csv -o path.csv", "The points of its path:" },
    { "pixel", "kerrd pixel --at 240,150 --size 640x360", "What a pixel of the default scene shows, and why:" },
    { "orbit", "kerrd orbit --spin 0.9 --p 6 --e 0.5 --inclination-deg 30 -o orbit.csv", "A bound orbit by its shape:" },
    { "orbit", "kerrd orbit --case zoom-whirl --format json", "One that is known by name:" },
    { "line", "kerrd line --spin 0.99 --inclination-deg 40 --format csv", "The profile of an iron line:" },
    { "transfer-function", "kerrd transfer-function --spin 0.9 --inclination-deg 60 -o transfer.csv", "How the rings of a disk are seen:" },
    { "spectrum", "kerrd spectrum --spin 0.9 --inclination-deg 60 --format csv", "The spectrum of a thin disk:" },
    { "visibility", "kerrd visibility --size 128x128 --format csv", "What an interferometer measures of the default scene:" },
    { "playground", "kerrd playground --preset system --time 100 --series energy.csv -o later.json", "Bodies that pull one another, after 100 M:" },
    { "playground", "kerrd playground later.json --time 100 -o -", "The same bodies, another 100 M later:" },
    { "physics", "kerrd physics kerr --spin 0:0.998:100 --format csv", "Radii of a hole as its spin grows:" },
    { "physics", "kerrd physics qnm --mass-msun 62 -o ringdown.wav", "A ringdown that can be heard:" },
    { "plan", "kerrd plan --preset gargantua --size 1920x1080", "What a picture would cost:" },
    { "scene", "kerrd scene --set camera.inclination_deg=60 > scene.json", "The default scene with one field changed, as a document:" },
    { "scene", "kerrd scene scene.json --hash", "The hash of a scene:" },
    { "presets", "kerrd presets", "All of them:" },
    { "serve", "kerrd serve", "On this machine alone, http://127.0.0.1:8080/:" },
    { "serve", "kerrd serve --listen 0.0.0.0 --insecure --state state", "For a network on which everybody may use it, with jobs that survive a restart:" },
    { "serve", "kerrd serve --log-level info --log-format json", "With a line of JSON for each request:" },
    { "doctor", "kerrd doctor", "What is here, and whether it works:" },
    { "doctor", "kerrd doctor --devices", "The devices that --device chooses from:" },
    { "bench", "kerrd bench accuracy --quick --seconds 0.001", "A first impression:" },
};
const size_t kd_n_examples = sizeof kd_examples / sizeof *kd_examples;

const struct kd_variable kd_variables[] = {
    { "KERRD_DEVICE", NULL, "the Vulkan device, where --device names none; as that takes it" },
    { "KERRD_VALIDATE", NULL, "1: use Vulkan's validation layer and report what it finds, for developers" },
    { "XDG_CACHE_HOME", NULL, "the folder in which kerrd/ keeps compiled kernels, and what has been measured of a device; ~/.cache where it is not set" },
    { "HOME", NULL, "the folder of ~/.cache" },
    { "VK_DRIVER_FILES", NULL, "the drivers that Vulkan's loader looks at, instead of those that are installed" },
    { "LP_NUM_THREADS", "bench", "how many threads lavapipe has: its speeds are told per core" },
    { "TMUX", "view", "where it is set, tmux stands before the terminal, and a refusal says so" },
    { "PATH", "film serve", "the folders in which the program ffmpeg is sought, which encodes films" },
    { "TMPDIR", "sweep film serve", "the folder of temporary files; /tmp where it is not set" },
};
const size_t kd_n_variables = sizeof kd_variables / sizeof *kd_variables;
