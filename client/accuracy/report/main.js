// The page from top to bottom.

function introduction(report) {
    const { scene, size, reference } = report;
    document.title = `What accuracy costs: ${scene.name}`;
    const history = report.degrees_per_frame === 0
        ? `The camera rests, and denoisers that remember had ${report.history} frames to do so: their best case.`
        : `The camera turns by ${number(report.degrees_per_frame)} degrees a frame for ${report.history} frames before each measured one.`;
    document.getElementById("report").append(
        element("h1", {}, `What accuracy costs: ${scene.name}`),
        paragraph(`${size[0]}\u00d7${size[1]} on ${report.gl_renderer} (${report.device}), ${report.date}. Every error is the mean over ${report.seeds} seeds `
            + `against a reference of ${reference.samples} samples a pixel in ${reference.batches} batches with other seeds, whose own relMSE is ${number(reference.relmse, 2)}. `
            + history),
        paragraph(element("code", {}, "relMSE = mean((x \u2212 r)\u00b2 / (r\u00b2 + 0.01))"),
            ` over pixels and channels, x the frame, r the reference, linear radiance before tone mapping. Truth ends where the scene's longest paths do (max_depth ${reference.max_depth}). ${countedPixels(reference)}`),
        shortAnswer(report));
}

function countedPixels({ counted_share: share }) {
    return share === undefined || share === 1 ? "All pixels count."
        : `${percent(1 - share)} of the pixels show no surface and no light that is left to chance: every frame of full resolution has them right, and they count in no error.`;
}

/** The frontier in a few sentences. */
function shortAnswer(report) {
    const first = report.prices[0];
    const sentences = [];
    if (first) {
        sentences.push(`The cheapest frame, ${first.label}, takes ${milliseconds(first.ms)} at relMSE ${number(first.relmse)}.`);
        sentences.push(first.to
            ? `To halve its error costs ${milliseconds(first.extra_ms)} more, by ${first.by}.` : "Nothing in this sweep halves its error.");
    } else
        sentences.push("No frame has an error that can be told from the reference's own noise, so nothing here has a price.");
    for (const fit of report.fits.filter(({ crossing_ms }) => crossing_ms))
        sentences.push(`After ${milliseconds(fit.crossing_ms)} spent on one picture (t*), plain averaging has less error than ${fit.denoiser} with the same time in one frame.`);
    return element("p", { class: "answer" }, sentences.join(" "));
}

function costSections(report) {
    const frontier = report.points.filter((point) => point.frontier).sort((a, b) => a.frontier - b.frontier);
    errorTimePlot(section("error-time", "Error against time"), report, "relmse", frontier);
    section("prices", "The price list: what the next halving costs", priceTable(report),
        paragraph("From each point of the frontier to the cheapest one with at most half of its error. The last column is how long plain averaging of raw frames takes to get there, while camera and scene rest. "
            + "Points too near the reference's own noise (\u2020 below) take no part, so one of them may beat points of the frontier."));
    errorTimePlot(section("flip-time", "The same in FLIP, the difference people see"), report, "flip", report.flip_frontier.map((at) => report.points[at]));
    passPlot(section("passes", "Where the time goes"), frontier);
}

function techniqueSections(report) {
    section("techniques", "What each technique costs and brings", techniqueTable(report),
        paragraph("Light left to chance is measured for this table alone: it is on no frontier."));
    const { effects } = report;
    const general = effects.general;
    section("effects", "What each effect of the scene costs and brings", effectTable(effects),
        paragraph(`Where the scene can do without an effect, it was edited away and put back in turns; the noise is that of one raw sample a pixel, mean(Var x / (E[x]\u00b2 + 0.01)), in the scene with and without. `
            + `What else is in the list cannot be left out alone; its cost is in the whole. Programs that hold every effect take ${withInterval(general, "ratio")} times as long as this scene's own. `
            + `What an effect costs that is compiled in for nothing is told by `, element("code", {}, "farlight bench --effects --leave-one-in"), `. ${refusals(effects)}`));
}

function responseSection(report) {
    const { response } = report;
    const host = section("response", "Unrest at rest, and a change of light", responseTable(response),
        paragraph(`Flicker = mean over pixels of std\u209c(L) / (mean\u209c(L) + 0.01) over ${response.still_frames} frames after ${response.history}, nothing moving, ${response.seeds} seeds.`));
    if (!response.step) {
        host.append(paragraph("No step response: the scene has no file in Farlight's own format (or it was a running server's), or it names no light that could be dimmed."));
        return;
    }
    host.append(paragraph(`From one frame to the next ${response.step}; the error of the frames that follow is against a reference of the new light. Lag: frames until it is below twice what it settles at.`));
    sequencePlot(host, response.points, { title: "relMSE after the light has changed", x: "frames after the step", first: 0 });
}

function motionSection({ motion }) {
    const host = section("motion", "Lamps that move");
    if (!motion?.points) {
        host.append(paragraph(motion?.refused ? `Not measured: the server refuses to move the lamps (${motion.refused}).`
            : "Not measured: the scene has no file in Farlight's own format (or it was a running server's), or it names no lamp that could be moved."));
        return;
    }
    host.append(paragraph(`After ${motion.history} frames at rest ${motion.what} within ${motion.frames} frames, and then stops. Each frame's error is against a reference of its own moment. `
        + `Flicker = mean over pixels of std\u209c(L \u2212 R) / (mean\u209c(L) + 0.01) while they move, R that reference: what the lamps themselves change is no flicker. Lag: frames after they stop until the error is below twice what it settles at.`),
    motionTable(motion));
    sequencePlot(host, motion.points, {
        title: "relMSE while lamps move", x: "frame of the motion", first: 1, verticals: [{ x: motion.frames + 0.5, text: "the lamps stand still" }],
    });
}

function pictureSection(report) {
    gallerySection(section("gallery", "Frames and where they are wrong",
        paragraph("Click any picture to see the reference in its place, again to go back. All frames share the scales, whose ends one pixel in a hundred is beyond.")), report.gallery);
}

function tableSections(report) {
    section("classic", "The classic comparison", classicTable(report),
        paragraph("Raw path tracing at growing samples a pixel against denoised frames of one sample: frames a second and error."));
    section("points", "All points", element("details", {}, element("summary", {}, `${report.points.length} points, as in accuracy.csv`), pointTable(report)),
        paragraph("\u2020 Within five standard deviations of the reference's own noise: not on the frontier, not in fits."));
}

function methodSection(report) {
    const { timing, timing_check: check, slope, averaging } = report;
    const items = [
        `Times are sums of pass times on the device as frames tell them, medians with 95 % intervals over turns (Student's t on their medians' logarithms). The points took turns in ${timing.rounds} rounds, forth and back (A B B A); of each turn ${timing.settling_frames} frames settled and ${timing.frames_a_turn} counted. Clocks are not locked. Encoding (JPEG) is apart.`,
        check.points
            ? `The sum of the passes differs from the whole frame by at most ${percent(check.worst)} (tolerance ${percent(check.tolerance)}, exceeded by ${check.beyond} of ${check.points} points).`
            : "The server does not tell the time of whole frames, so pass times could not be checked against them.",
        "Intervals of errors are 95 % studentised bootstrap over the seeds. Bias\u00b2 is the mean product of the deviations of different seeds, noise is the rest; what the reference's own noise adds is taken off both.",
        `Fit of each denoiser over samples: error(t) = b\u00b2 + c / t, where b\u00b2 is the bias that the seeds show at its most samples, or is fitted too where they show none; averaged frames: error(t) = ${number(averaging.rate)} ms / t. They cross at t* = (c_averaged \u2212 c) / b\u00b2.`,
        slope ? `Raw samples: error falls with samples to the power ${number(slope.mse)} (MSE) and ${number(slope.relmse)} (relMSE); \u22121 is what theory asks for.`
            : "Raw samples have too little error to say how it falls with samples.",
        "All pictures look through pixel middles, as moving ones do, the reference too. Frames smaller than the picture are enlarged bilinearly before they are compared.",
    ];
    section("method", "How this was measured", element("ul", {}, ...items.map((item) => element("li", {}, item))));
}

function showReport() {
    const report = JSON.parse(document.getElementById("data").textContent);
    introduction(report);
    costSections(report);
    techniqueSections(report);
    pictureSection(report);
    responseSection(report);
    motionSection(report);
    tableSections(report);
    methodSection(report);
    window.addEventListener("resize", resizePlots);
    window.addEventListener("beforeprint", resizePlots);
    window.matchMedia("print").addEventListener("change", resizePlots);
    document.body.dataset.ready = "true";
}

showReport();
