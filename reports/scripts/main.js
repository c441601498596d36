// What the page does when it is there.
"use strict";

function dataOf(id) {
  const element = document.getElementById(id);
  return element ? JSON.parse(element.textContent) : null;
}

function begin() {
  const question = document.getElementById("question");
  if (question) new Table(question, document.getElementById("rows"));
  const marks = dataOf("marks") || {};
  for (const figure of document.querySelectorAll("figure[data-item]")) {
    const table = marks[figure.dataset.item];
    new Tools(figure, table);
    // Marks are looked up when a figure is first pointed at or reached.
    const draws = figure.closest("article").querySelector(".facts dd").textContent.trim();
    if (table) once(figure.querySelector(".plate"), ["pointerenter", "focus"], () => new Reading(figure, table, draws));
  }
  for (const thumb of document.querySelectorAll(".thumb")) {
    // A copy of a whole figure takes its time: it is made when it is near, or for paper.
    const show = () => {
      const kept = thumb.querySelector("noscript");
      if (kept) thumb.innerHTML = kept.textContent;
    };
    whenNear(thumb, show);
    addEventListener("beforeprint", show);
  }
  const lab = document.getElementById("lab-room");
  if (lab) {
    const { stored, claims } = dataOf("lab-data");
    whenNear(lab, () => new Lab(lab, stored, claims));
  }
  follow(document.getElementById("contents"));
}

function once(element, events, action) {
  const done = () => {
    events.forEach((name) => element.removeEventListener(name, done));
    action();
  };
  events.forEach((name) => element.addEventListener(name, done));
}

function whenNear(element, action) {
  const watch = new IntersectionObserver((seen) => {
    if (!seen.some((one) => one.isIntersecting)) return;
    watch.disconnect();
    action();
  }, { rootMargin: "600px" });
  watch.observe(element);
}

// Mark in the contents what is being read.
function follow(contents) {
  const links = new Map([...contents.querySelectorAll("a")].map((link) => [link.hash.slice(1), link]));
  const watch = new IntersectionObserver((seen) => {
    for (const { target, isIntersecting } of seen) {
      const link = links.get(target.getAttribute("aria-labelledby"));
      if (link) link.toggleAttribute("data-here", isIntersecting);
    }
    const here = [...links.values()].filter((link) => link.hasAttribute("data-here"));
    for (const link of links.values()) link.removeAttribute("aria-current");
    here[0]?.setAttribute("aria-current", "true");
  }, { rootMargin: "-20% 0px -60% 0px" });
  document.querySelectorAll("main > section").forEach((section) => watch.observe(section));
}

begin();
