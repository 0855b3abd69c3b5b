// Replaces the page of a shared scene by the main page with that scene, in the same entry of the browser's history.
location.replace(document.getElementById('open').href);
