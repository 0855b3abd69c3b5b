// The page of a shared scene leads to the page with that scene, which takes its place in the browser's history.
location.replace(document.getElementById('open').href);
