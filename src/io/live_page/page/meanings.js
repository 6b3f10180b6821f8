// SPDX-License-Identifier: Apache-2.0
// What each number of the page means, for the tap on it.

const MEANINGS = {
  "σ major, minor": "Half the long and the short axis of the ellipse around the position that holds the object with 39 % probability (1 sigma). " +
    "Twice these axes, as drawn on the map, hold it with 86 %.",
  "Major axis": "Direction in which the position is least certain, clockwise from true north.",
  "Object's height": "Height of the object above the place where the flight began, and its uncertainty (1 sigma).",
  "Above sea level": "Height of the object above mean sea level, as the vehicle knows its own.",
  "Class": "What the detector takes the object for, by the majority of its looks.",
  "Confidence": "How sure geoloc is that there is an object, from the detector's confidence in all looks.",
  "Speed, course": "Speed over ground, and its direction clockwise from true north.",
  "Hits": "Frames in which the object was detected.",
  "First seen": "Time of the first frame that shows the object.",
  "Last seen": "Time of the last frame that shows the object.",
  "From vehicle": "Direction clockwise from true north and horizontal distance, from the vehicle to the object.",
  "From you": "Direction clockwise from true north and horizontal distance, from your position to the object.",
  "Vehicle's height": "Height of the vehicle above the place where the flight began, as its autopilot reports it.",
  "Heading": "Where the vehicle's nose points, clockwise from true north.",
  "Attitude": "Attitude messages per second. Below 10 the position between them is guessed.",
  "Position": "Position messages of the autopilot per second.",
  "Video": "Frames of the video per second.",
  "Frame times": "Where the capture times of frames come from: \"recovered\" from the camera's own clock, or \"arrival\" of the frame at this computer.",
  "Detection": "Time that the detector takes for one frame, on average.",
  "Capture to result": "Time from a frame's capture until its objects are known, on average.",
  "Delay of the vehicle's position": "The vehicle tells where it was this long before, as seen against its attitude. geoloc corrects for it.",
  "Image delay": "A frame shows the world this long before the time it is stamped with. geoloc corrects for it.",
  "Camera turned about its x axis": "The camera is turned by this about the axis to the image's right, against the mount that is set. geoloc corrects for it.",
  "Camera turned about its y axis": "The camera is turned by this about the axis to the image's bottom, against the mount that is set. geoloc corrects for it.",
  "Camera turned about its z axis": "The camera is turned by this about its optical axis, against the mount that is set and the vehicle's compass. geoloc corrects for it.",
  "Error of the focal length": "The camera's focal length is this much longer than its settings say. geoloc corrects for it. Seen straight down from one height, it cannot be told from an error of the height.",
  "Error of the vehicle's height": "The camera is this much higher above the ground than the vehicle reports. It is a correction, not an altitude.",
  "Error of the vehicle's position, east": "The vehicle is this much further east than it reports. Without known points the error common to all positions cannot be seen.",
  "Error of the vehicle's position, north": "The vehicle is this much further north than it reports. Without known points the error common to all positions cannot be seen.",
  "Frames": "Frames that were searched for objects.",
  "Frames located": "Frames for which the vehicle's position and attitude were known.",
  "Frames without state": "Frames left out because the vehicle's position and attitude at their time were not known.",
  "Frames damaged": "Frames left out because their images arrived damaged.",
  "Detections": "Detections in located frames.",
  "Without ground point": "Detections whose line of sight does not meet the ground, for example above the horizon.",
  "Attitudes": "Attitude messages received.",
  "Positions": "Position messages received.",
  "Reboots": "Restarts of the autopilot during the run.",
  "Jumps of the position": "Times that the vehicle's reported position jumped.",
  "Jumps of the height": "Times that the vehicle's reported height jumped.",
  "Jumps of the yaw": "Times that the vehicle's reported heading jumped.",
  "Jumps of home": "Times that the vehicle moved the point its heights are measured from.",
  "Clock steps": "Jumps of the vehicle's clock against this computer's.",
  "Latency changes": "Times that the image delay was found to have changed.",
  "Frames turned": "Frames in which the vehicle's heading was found to be 180° off.",
  "Tracks made": "Candidates for objects, begun from detections.",
  "Tracks removed": "Candidates that proved to be no objects.",
  "Tracks merged": "Candidates that proved to be objects already known.",
};

/** Marks an element as one whose name is explained by a tap. */
export function explain(made, name) {
  if (!MEANINGS[name]) return made;
  made.dataset.meaning = name;
  made.tabIndex = 0;
  made.setAttribute("role", "button");
  return made;
}

/** Shows meanings in `dialog`, whatever element of the page is tapped. */
export function showMeanings(dialog) {
  const show = (event) => {
    const name = event.target.closest?.("[data-meaning]")?.dataset.meaning;
    if (!name) return;
    event.preventDefault();
    dialog.querySelector("h2").textContent = name;
    dialog.querySelector("p").textContent = MEANINGS[name];
    dialog.showModal();
  };
  document.addEventListener("click", show);
  document.addEventListener("keydown", (event) => {
    if (event.key === "Enter" || event.key === " ") show(event);
  });
  dialog.querySelector("button").addEventListener("click", () => dialog.close());
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close(); // the ground around it
  });
}
